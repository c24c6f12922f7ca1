// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_SCENES_H
#define EP_TEST_SCENES_H

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "scenefile/SceneFile.h"

namespace ep
{
/// A file of the test's own, which is gone when it ends.
class TemporaryFolder
{
public:
	TemporaryFolder()
		: m_path(std::filesystem::temp_directory_path() /
				 (std::string("ep-") + testing::UnitTest::GetInstance()->current_test_info()->test_suite_name() + "-" +
				  testing::UnitTest::GetInstance()->current_test_info()->name() + "-" +
				  std::to_string(sizeof(btScalar)) + "-" + std::to_string(getpid())))
	{
		std::filesystem::create_directories(m_path);
	}
	~TemporaryFolder()
	{
		std::error_code ignored;
		std::filesystem::remove_all(m_path, ignored);
	}
	TemporaryFolder(const TemporaryFolder&) = delete;
	TemporaryFolder& operator=(const TemporaryFolder&) = delete;

	std::string write(const std::string& name, const std::string& text) const
	{
		std::ofstream(m_path / name) << text;
		return (m_path / name).string();
	}
	std::string path() const { return m_path.string(); }

private:
	std::filesystem::path m_path;
};

/// A scene with what stands between the braces, in line 1; in line 2 a body, if it has none.
inline SceneDescription sceneOf(const std::string& inner, const std::vector<Setting>& settings = {})
{
	const std::string body =
		inner.find("\"bodies\"") == std::string::npos ? ",\n\"bodies\": [{\"name\": \"box\", \"box\": [1, 1, 1]}]" : "";
	return describeScene(
		SceneText::parse("{\"version\": 1" + (inner.empty() ? "" : ", " + inner) + body + "}", "test.json", settings));
}

/// What is complained of, empty: nothing.
template <class Act>
std::string complaintOf(const Act& act)
{
	try
	{
		act();
	}
	catch (const SceneError& error)
	{
		return error.what();
	}
	return "";
}

inline std::string complaintOf(const char* inner)
{
	return complaintOf([&] { sceneOf(inner); });
}

/// Each of the parts is in the text.
inline void expectParts(const std::string& text, const std::vector<std::string>& parts)
{
	for (const std::string& part : parts)
		EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}
}  // namespace ep

#endif  // EP_TEST_SCENES_H

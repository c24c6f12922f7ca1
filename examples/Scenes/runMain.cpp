// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// ep-run: computes a scene file, or many variants of it.

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "cases/CaseRunner.h"
#include "cli/CommandLine.h"
#include "run/CaseTable.h"
#include "run/RunFiles.h"
#include "scenefile/SceneFile.h"
#include "text/Format.h"
#include "text/OutputFiles.h"
#ifdef EP_WITH_GLTF
#include "gltf/GltfFilm.h"
#endif

namespace
{
namespace fs = std::filesystem;

/// What the program's end tells: errors of input are 1.
enum Status
{
	FINISHED = 0,
	NOT_FINITE = 2,
	NOT_AS_EXPECTED = 3
};

struct Options
{
	explicit Options(ep::CommandLine& line)
	{
		line.add("scene", scene, "A scene's file (docs/scenes.md)");
		line.add("--out", out, "Folder for what comes of it").showDefault();
		line.add("--set", settings, "path=value: a parameter, or a value in the file such as world.step=0.01");
		line.addFlag("--check", isCheck, "Says whether the file is right, and ends");
		line.addFlag("--print", isPrint, "Prints the file as plain JSON, with what it includes, and ends");
		line.addFlag("--schema", isSchema, "Prints the JSON Schema of scene files, and ends");
		line.add("--export", film, "Writes a film of it as glTF 2.0, for Blender and others: FILE.glb");
		line.addFlag("--quiet", isQuiet, "No progress");
		line.add("--sweep", sweeps, "path=from:to:count: cases with evenly spread values; several: all combinations");
		line.add("--random", random, "How many cases are drawn by --vary").within(1, 1000000);
		line.add("--vary", vary, "path=normal(mean,deviation), uniform(from,to) or lognormal(median,deviation)");
		line.add("--seed", seed, "Of what is drawn").showDefault();
		line.add("--jobs", jobs, "Cases computed at the same time").within(1, 1024).showDefault();
		line.add("--shard", shard, "i/n: only every n-th case from the i-th; the same folder collects all shards");
	}

	std::string scene, out = "run", shard, film;
	std::vector<std::string> settings, sweeps, vary;
	bool isCheck = false, isPrint = false, isSchema = false, isQuiet = false;
	int random = 0, jobs = 1;
	unsigned seed = 1;
};

/// Tells how far a run is, now and then.
class Progress
{
public:
	explicit Progress(bool isQuiet) : m_isQuiet(isQuiet) {}

	void tell(double time, double end)
	{
		const auto now = Clock::now();
		if (m_isQuiet || now < m_next)
			return;
		m_next = now + std::chrono::seconds(1);
		const double passed = std::chrono::duration<double>(now - m_begin).count();
		if (time > 0)
			std::cerr << ep::format("%.3f s of %.3f s, at most %.0f s left\n", time, end, passed / time * (end - time));
	}

private:
	using Clock = std::chrono::steady_clock;
	bool m_isQuiet;
	Clock::time_point m_begin = Clock::now(), m_next = m_begin + std::chrono::seconds(1);
};

std::vector<ep::Setting> settingsOf(const std::vector<std::string>& texts)
{
	std::vector<ep::Setting> settings;
	for (const std::string& text : texts)
		settings.push_back(ep::Setting::from(text));
	return settings;
}

#ifdef EP_WITH_GLTF
typedef ep::GltfFilm Film;
#else
/// Where glTF cannot be written.
struct Film
{
	explicit Film(const ep::Simulation&) {}
	void step() {}
	void write(const std::string& file) const
	{
		throw std::runtime_error("'" + file + "' cannot be written: built without tinygltf");
	}
};
#endif

/// \return the program's status
int runOne(const Options& o, const ep::SceneDescription& scene)
{
	ep::Simulation simulation(scene);
	ep::RunFiles files(simulation);
	const std::unique_ptr<Film> film = o.film.empty() ? nullptr : std::make_unique<Film>(simulation);
	Progress progress(o.isQuiet);
	while (simulation.ending() == ep::Ending::None)
	{
		simulation.step();
		files.step();
		if (film)
			film->step();
		progress.tell(simulation.time(), scene.end.time);
	}
	files.write(o.out);
	if (film)
		film->write(o.film);
	const auto summary = files.summary();
	const std::string ending = ep::nameOf(ep::endings(), simulation.ending());
	std::cout << ep::format("%.3f s (%s), %d of %zu joints broken, in ", simulation.time(), ending.c_str(),
							simulation.numBroken(), scene.joints.size())
			  << o.out << "\n";
	for (const auto& unmet : summary.at("not_as_expected"))
		std::cout << "not as expected: " << unmet.get<std::string>() << "\n";
	if (simulation.ending() == ep::Ending::NotFinite)
		return NOT_FINITE;
	return summary.at("not_as_expected").empty() ? FINISHED : NOT_AS_EXPECTED;
}

/// A folder is for one variation of one scene.
void claim(const fs::path& file, const std::string& what)
{
	std::ifstream stream(file);
	if (stream)
	{
		const std::string begun((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
		if (begun != what)
			throw std::runtime_error("'" + file.string() + "' tells that this folder was begun with " +
									 "another scene or other cases: give another folder (--out)");
	}
	else
		ep::writeText(file.string(), what);
}

ep::CaseJob jobOf(const Options& o, const ep::Variation& variation, size_t index, const std::string& program)
{
	std::string command = ep::shellWord(program) + " " + ep::shellWord(o.scene) + " --quiet";
	for (const std::string& setting : o.settings)
		command += " --set " + ep::shellWord(setting);
	for (size_t k = 0; k < variation.paths.size(); ++k)
		command += " --set " + ep::shellWord(variation.paths[k] + "=" + variation.cases[index][k]);
	// What is not as expected is a result, and so is what is not finite.
	command += " --out ";
	return {ep::caseName(index), ep::caseName(index), [command](const std::string& part) {
				return command + ep::shellWord(part) + " >/dev/null || case $? in 2|3) ;; *) exit 1 ;; esac";
			}};
}

/// What the first of the cases that have failed says, without the command and its status.
std::string firstFailure(const std::vector<ep::CaseJob>& jobs, const fs::path& folder)
{
	for (const ep::CaseJob& job : jobs)
	{
		std::ifstream file(folder / (job.name + ".failed"));
		std::string line;
		if (!file || !std::getline(file, line) || !std::getline(file, line))
			continue;
		return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
	}
	return {};
}

int runMany(const Options& o, const ep::SceneText& text, const std::string& program)
{
	const ep::Variation variation = ep::Variation::make(o.sweeps, o.random, o.vary, o.seed);
	const fs::path out(o.out), folder = out / "cases";
	ep::makeDirectory(folder.string());
	claim(out / "variation.csv", variation.text());
	claim(out / "scene.json", text.root.json() + "\n");
	std::vector<ep::CaseJob> jobs;
	for (size_t i : ep::shardOf(variation.cases.size(), o.shard))
		jobs.push_back(jobOf(o, variation, i, program));
	const int failed = ep::runCases(jobs, folder.string(), o.jobs);
	const std::string table = (out / "cases.csv").string();
	ep::writeText(table, ep::caseTable(variation, folder.string()));
	std::cout << "Table in " << table << "\n";
	if (failed > 0)
		throw std::runtime_error(std::to_string(failed) + " cases failed: see the .failed files in " + folder.string() +
								 ". The first one says:\n" + firstFailure(jobs, folder));
	return FINISHED;
}

int run(const Options& o, const char* self)
{
	if (o.isSchema)
	{
		std::cout << ep::sceneSchema();
		return FINISHED;
	}
	if (o.scene.empty())
		throw std::runtime_error("a scene's file is missing; --help tells more");
	const ep::SceneText text = ep::SceneText::read(o.scene, settingsOf(o.settings));
	const ep::SceneDescription scene = ep::describeScene(text);
	if (o.isPrint)
		std::cout << text.root.json() << "\n";
	else if (o.isCheck)
	{
		ep::Simulation simulation(scene);
		std::cout << ep::format("%zu bodies and %zu joints: all is well\n", scene.bodies.size(), scene.joints.size());
	}
	else if (!o.sweeps.empty() || !o.vary.empty() || o.random > 0)
		return runMany(o, text, (fs::path(ep::programFolder(self)) / fs::path(self).filename()).string());
	else if (!o.shard.empty())
		throw std::runtime_error("--shard is for the cases of --sweep or --random");
	else
		return runOne(o, scene);
	return FINISHED;
}
}  // namespace

int main(int argc, char** argv)
{
	ep::CommandLine line("Computes a scene file, or many variants of it");
	Options options(line);
	if (const std::optional<int> status = line.parse(argc, argv))
		return *status;
	try
	{
		return run(options, argv[0]);
	}
	catch (const ep::SceneError& error)
	{
		std::cerr << error.what() << "\n";
	}
	catch (const std::exception& error)
	{
		std::cerr << "ep-run: " << error.what() << "\n";
	}
	return 1;
}

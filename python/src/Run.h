// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PYTHON_RUN_H
#define EP_PYTHON_RUN_H

#include "run/RunFiles.h"
#include "scenefile/SceneBuilder.h"
#include "scenefile/SceneText.h"

namespace ep
{
/// A scene that is computed as ep-run does it, step by step, with what a person may do to it meanwhile: what the package in Python is
/// made of. All errors are SceneErrors, or std::runtime_errors of files.
class Run
{
public:
	/// Throws a SceneError with all that is wrong with the scene.
	explicit Run(const SceneText& text);

	const Simulation& simulation() const { return *m_simulation; }
	const std::vector<Column>& columns() const { return m_files->columns(); }

	/// The scene as plain JSON, with what it includes.
	const std::string& sceneJson() const { return m_json; }
	std::string summaryJson() const { return m_files->summary().dump(); }

	/// By a name or a pattern, in the scene's order; throws a SceneError if there is none. \param what  whose name it is, such as on
	std::vector<int> bodiesLike(const std::string& what, const std::string& pattern) const;
	std::vector<int> jointsLike(const std::string& what, const std::string& pattern) const;

	/// \param beforeSubstep  may be empty. What it throws is thrown when the step is whole.
	void step(const std::function<void(double time)>& beforeSubstep);

	/// \return the load's number
	int addLoad(const SceneDescription::Load& load);
	void removeLoad(int number);
	void setLoad(int number, const btVector3& force, const btVector3& moment);

	void removeBody(int index);
	void cutJoint(int index);
	void pushBody(int index, const btVector3& velocity);

	/// As ep-run writes it.
	void write(const std::string& folder) const { m_files->write(folder); }

	/// The scene, its state and what has been read, as bytes.
	std::string save();

	/// Throws a SceneError, and nothing changes, if it is not a state of this scene. Added loads stay.
	void restore(const std::string& state);

	/// The scene of a state.
	static std::string sceneOf(const std::string& state);

private:
	/// In a step of its own nothing may come or go.
	void refuseInStep(const char* what) const;
	SceneDescription::Load& load(int number);

	std::string m_json;
	std::unique_ptr<Simulation> m_simulation;
	Names m_bodies, m_joints;
	std::unique_ptr<RunFiles> m_files;
	bool m_isInStep = false;
};
}  // namespace ep

#endif  // EP_PYTHON_RUN_H

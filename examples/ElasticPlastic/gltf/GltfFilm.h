// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_GLTF_FILM_H
#define EP_GLTF_FILM_H

#include <string>

#include "simulation/Simulation.h"

namespace ep
{
/// A simulation as a glTF 2.0 file (GLB): a node with a mesh for each body and its track, and a node for each joint, at the body that holds
/// it, with its utilisation over time as "extras"; breaks and other events are extras of the scene. Members that are bent have a skin, by which
/// they look bent.
class GltfFilm
{
public:
	/// \param interval  from picture to picture of the tracks [s]; those that the simulation's steps do not hit come after it
	explicit GltfFilm(const Simulation& simulation, double interval = 1. / 60);

	/// After each step.
	void step();

	/// Throws a std::runtime_error if it cannot be written.
	void write(const std::string& file) const;

private:
	struct Frame
	{
		double time;
		std::vector<btTransform> poses;  ///< of bodies
		std::vector<bool> areThere;
		std::vector<btTransform> wheels;
		std::vector<float> utilisations;  ///< of joints
		std::vector<bool> areWhole;       ///< joints of ours that hold their bodies
	};

	class Model;

	void record();

	const Simulation& m_simulation;
	double m_interval;
	std::vector<Frame> m_frames;
};
}  // namespace ep

#endif  // EP_GLTF_FILM_H

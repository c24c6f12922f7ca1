// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_STRUCK_BEAM_H
#define EP_STRUCK_BEAM_H

#include <functional>

#include "world/World.h"

namespace ep
{
/// A beam between two supports, whose left end they hold in all directions, struck in the middle by a heavy body that does not turn. What
/// is held at both ends hangs as a cable in the end, or stands as an arch.
struct StruckBeam
{
	struct Settings
	{
		Method method = Solver::Direct;
		int halfParts = 10;                ///< parts of each half
		double length = 1, height, width;  ///< [m]
		double density;                    ///< of the parts [kg/m^3]
		double mass, speed;                ///< of the body that strikes [kg], [m/s]
		/// Whether the right end is held as the left one is; else it is borne across the beam alone.
		bool isHeld = true;
		/// By the lengths of the parts that a joint joins, 0 of what is rigid [m].
		std::function<btElasticPlasticCapacity(btScalar lengthA, btScalar lengthB)> capacity;
	};

	/// A square bar of steel of 20 mm and 250 MPa, 1 m long in 20 parts, under 50 kg.
	/// \param section  of the bar, cut into fibres
	static Settings ofSteel(const Method& method, const btElasticPlasticSection& section, double speed);

	/// Reinforced concrete, 300 x 500 mm and 6 m long in 12 parts, with a bar of 20 mm in each corner, under 2 t at 6 m/s.
	/// \param concrete      of the section, cut into fibres
	/// \param tensileShare  of the concrete's strength: with 0 a crack has to close before it bears again
	static Settings ofConcrete(const Method& method, const btElasticPlasticSection& concrete, bool isHeld,
							   double tensileShare);

	explicit StruckBeam(const Settings& settings);

	/// [m]
	double sag() const { return -double(m_striker->getCenterOfMassPosition().y()); }
	double sagRate() const { return -double(m_striker->getLinearVelocity().y()); }

	World m_world;
	btRigidBody* m_striker = nullptr;
	btElasticPlasticJoint* m_atSupport = nullptr;  ///< the left one
};
}  // namespace ep

#endif  // EP_STRUCK_BEAM_H

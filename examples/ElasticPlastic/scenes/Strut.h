// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_STRUT_H
#define EP_STRUT_H

#include <vector>

#include "world/World.h"

namespace ep
{
/// A strut of an aluminium alloy, 100 x 50 mm, with hinges at both ends, which a head that goes along it presses together until it buckles, at the
/// tangent modulus load (Engesser, Shanley): with the slope E_t of the stress over the strain at the stress s itself,
///
///     s = pi^2 E_t(s) / slenderness^2.
struct Strut
{
	/// The alloy by Ramberg and Osgood: strain = s / E + 0.002 (s / f)^10.
	struct Alloy
	{
		static double plasticStrain(double stress);
		static double tangentModulus(double stress);
		static double strain(double stress);
		static double bucklingStress(double slenderness);
		/// \param kinematicShare  of its hardening
		static btElasticPlasticMaterial material(double kinematicShare);
	};

	/// \param slenderness  length over the radius of inertia about the axis about which it bends
	/// \param fibres       of a section, about how many
	Strut(const Method& method, double slenderness, int parts, const btElasticPlasticMaterial& material,
		  int fibres = 0);

	/// A force in its middle makes it crooked by a ten-thousandth of its length. To be put on in each substep.
	/// \param share  of that force
	void push(double share);

	/// [Pa]
	double pressureAtFoot() const;

	/// Of its length in a second.
	static constexpr double SHORTENING = 2e-3;

	World m_world;

private:
	double m_length;
	std::vector<btRigidBody*> m_parts;
	btElasticPlasticJoint* m_foot = nullptr;
};
}  // namespace ep

#endif  // EP_STRUT_H

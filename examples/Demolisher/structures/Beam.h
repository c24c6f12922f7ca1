// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_BEAM_H
#define EP_BEAM_H

#include "scenes/Member.h"

namespace ep
{
/// The paper's materials: concrete gives the mass, steel carries all load.
struct Materials
{
	btScalar concreteDensity = 2000;         ///< [kg/m^3]
	btScalar steelDensity = 7800;            ///< [kg/m^3]
	btScalar yieldStress = btScalar(200e6);  ///< of the steel [Pa]
	btScalar ductility = btScalar(.2);       ///< plastic strain at which steel tears
	btScalar dampingRatio = btScalar(.02);   ///< of every mode, by the joints: nothing brakes a wreck that moves

	/// A share of steel spread evenly over the section, the rest concrete; 1 is steel alone.
	btElasticPlasticMaterial mixed(btScalar steelShare) const;
};

/// What a beam is made of. SI units; x runs along the beam, y along its height, z along its width.
struct BeamSettings
{
	int blocks = 10;
	btScalar length = 1;
	btScalar height = btScalar(.1), width = btScalar(.1);  ///< of the blocks
	btElasticPlasticSection section;                       ///< that carries the load
	btElasticPlasticMaterial material;
	btScalar hingeLength = 0;     ///< over which plastic bending spreads, 0: from joint to joint
	btScalar endHingeLength = 0;  ///< the same at a support, 0: as hingeLength
	btScalar friction = btScalar(.8);
	bool isRound = false;  ///< for those who draw it
};

/// A member as it is built: rubbing, with joints that stand for the steel between the blocks' centres and may tear.
class Beam : public Member
{
public:
	/// \param start  pose of the beam's beginning
	Beam(World& world, const std::string& name, const BeamSettings& settings, const btTransform& start);

	const BeamSettings& settings() const { return m_settings; }
	btScalar blockMass() const;

	/// Where the beam begins and ends now.
	btVector3 startPoint() const;
	btVector3 endPoint() const;

	/// E I and G A of bending about z.
	btScalar bendingStiffness() const;
	btScalar shearStiffness() const;

private:
	BeamSettings m_settings;
};
}  // namespace ep

#endif  // EP_BEAM_H

#ifndef EP_BRIDGE_H
#define EP_BRIDGE_H

#include <vector>

#include "World.h"

namespace ep
{
/// What the bridge is built of. SI units; x runs along the bridge, y up, z across, the origin below its middle.
struct BridgeSettings
{
	int blocks = 12;
	btScalar span = 24;                 ///< between the supports [m]
	btScalar width = 5;                 ///< of deck, supports and ramps [m]
	btScalar thickness = btScalar(.8);  ///< of the deck [m]
	btScalar height = btScalar(4.5);    ///< of the roadway above the ground [m]
	btScalar supportLength = 4;         ///< along the bridge [m]
	btScalar rampLength = 26;           ///< along the bridge [m]
	btScalar ledge = btScalar(.4);  ///< how far a support reaches under the deck, which falls on it when torn off [m]

	bool slidingEnd = true;  ///< the right end is free to slide lengthwise

	btScalar concreteDensity = 2000;         ///< [kg/m^3]
	btScalar steelDensity = 7800;            ///< [kg/m^3]
	btScalar steelShare = btScalar(.027);    ///< of the section; spread over it evenly, it carries all load
	btScalar yieldStress = btScalar(200e6);  ///< of the steel [Pa]
	btScalar hingeLength =
		btScalar(.4);  ///< over which plastic bending spreads, about half of the deck's thickness [m]
	btScalar dampingRatio = btScalar(.02);  ///< of the deck's first bending mode
};

/// Rigid ramps and supports at both ends, and between them a deck of concrete blocks. The blocks are joined to each other
/// and to the supports by elastic-plastic joints which stand for the steel between the blocks' centres.
class Bridge
{
public:
	Bridge(World& world, const BridgeSettings& settings);

	const BridgeSettings& settings() const { return m_settings; }
	const std::vector<btRigidBody*>& deck() const { return m_deck; }
	const std::vector<btRigidBody*>& supports() const { return m_supports; }

	/// From the left support to the right one.
	const std::vector<btElasticPlasticJoint*>& joints() const { return m_joints; }

	btScalar blockLength() const { return m_settings.span / m_settings.blocks; }
	btScalar blockMass() const;

	/// How far the middle of the deck is below where it was built [m].
	btScalar sag() const;

	/// The same by beam theory for the deck's own weight: a bar of the steel's bending and shear stiffness, clamped at both ends [m].
	btScalar beamSag(btScalar gravity) const;

	/// What the supports bear by way of the joints, positive upwards [N].
	btScalar supportForce() const;

private:
	btElasticPlasticMaterial material() const;
	btElasticPlasticSection section() const;
	btScalar deckDamping() const;
	btRigidBody* addSupport(World& world, btScalar side);
	void addRamp(World& world, btScalar side);
	void addJoint(World& world, btRigidBody& left, btRigidBody& right, int index);

	BridgeSettings m_settings;
	std::vector<btRigidBody*> m_deck;
	std::vector<btRigidBody*> m_supports;
	std::vector<btElasticPlasticJoint*> m_joints;
};
}  // namespace ep

#endif  // EP_BRIDGE_H

#ifndef EP_CHARPY_JOINTS_H
#define EP_CHARPY_JOINTS_H

#include <cmath>

#include "CharpyEnergy.h"

namespace ep
{
/// The joint between two pieces, in one of the ways of modelling. Energies are in Bullet's unit of length.
class CharpyJoint
{
public:
	virtual ~CharpyJoint() = default;
	virtual void beforeStep(btScalar) {}
	virtual void afterStep(btScalar) {}
	/// That it can be computed with [s].
	virtual double longestStep() const { return HUGE_VAL; }
	virtual bool isBroken() const = 0;
	virtual double plasticWork() const = 0;
	virtual double elasticEnergy() const = 0;
	virtual double numericalEnergy() const = 0;
};

/// What a joint has to bear, and where it is.
struct CharpyJointPlace
{
	btRigidBody *a, *b;
	btTransform frame;   ///< world, x along the specimen, y along the blow
	double height;       ///< of the section [m]
	double pieceLength;  ///< [m]
};

std::unique_ptr<CharpyJoint> makeCharpyJoint(World& world, CharpyEnergy& energy, const CharpySettings& settings,
											 const CharpyJointPlace& place);
}  // namespace ep

#endif  // EP_CHARPY_JOINTS_H

// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CHARPY_IMPACT_TEST_H
#define EP_CHARPY_IMPACT_TEST_H

#include "test/Joint.h"

namespace ep::charpy
{
enum class Outcome
{
	Swinging,  ///< not over yet
	Missed,    ///< the hammer has met nothing
	Passed,    ///< all pieces have gone through between the anvils
	Bounced,   ///< the hammer has swung back
	Stuck,     ///< the hammer has come to rest in the specimen
	Slipped    ///< the specimen has left the anvils over an edge, unbroken and before it was bent enough to pass
};
const char* nameOf(Outcome outcome);

/// What the test gives, SI units. Energies count from the step before the first contact.
struct Result
{
	Outcome outcome = Outcome::Swinging;
	double blowSpeed = 0;             ///< of the hammer where it strikes, before [m/s]
	double hammerBefore = 0;          ///< energy of the hammer, as seen from its rest at angle 0 [J]
	double hammerAfter = 0;           ///< [J]
	double plasticWork = 0;           ///< of all joints [J]
	double elasticEnergy = 0;         ///< in the joints, or in one when it broke [J]
	double specimenEnergy = 0;        ///< kinetic, of the pieces [J]
	double frictionWork = 0;          ///< what friction took [J]
	double contactWork = 0;           ///< what blows took, normal to the faces: they are inelastic [J]
	double numericalDissipation = 0;  ///< of joints, bearing and time integration [J]
	double hingeAngle = 0;            ///< bend at the notch, 0 if the specimen is rigid [rad]
	double greatestAngle = 0;         ///< of the hinge so far [rad]
	bool broken = false;              ///< any joint
	double plasticMoment = 0;         ///< [N m]
	double passingAngle = 0;          ///< by geometry, see Settings [rad]
	double duration = 0;              ///< from the first contact [s]
	double deepest = 0;               ///< penetration of any contact [m]
	long long substeps = 0;

	double loss() const { return hammerBefore - hammerAfter; }
	/// What none of these energies explains, over the loss.
	double auditError() const;
};

/// The paper's second example (section 3.2): a pendulum hammer strikes a notched specimen that lies before two anvils.
class ImpactTest
{
public:
	/// Simulated at most: a hammer that falls from the highest release takes 2 s down [s].
	static constexpr double LONGEST = 10;
	/// Of the hammer in a substep: so its bearing keeps up, and it does not jump over the specimen [rad].
	static constexpr double LARGEST_TURN = 0.05;

	/// Throws std::invalid_argument that says what is wrong with the settings.
	explicit ImpactTest(const Settings& settings);

	/// One step of the automatic time stepping, with its substeps.
	void step();
	/// A step of the given time instead [s].
	void step(double dt);
	/// Until it is over.
	Result run();

	bool isOver() const { return m_outcome != Outcome::Swinging; }
	Result result() const;

	/// The paper's automatic time stepping: swingStep at angles beyond swingAngle, step within impactAngle, linear between.
	double stepAt(double angle) const;
	/// Of equal length in a step of dt: none may turn the hammer by more than LARGEST_TURN or the hinge by more than
	/// hingeStep, or be too long for the joint.
	int substepsIn(double dt) const;

	double time() const { return m_time; }
	double angle() const;         ///< of the hammer, 0 where it strikes [rad]
	double angularSpeed() const;  ///< [rad/s]
	bool hasStruck() const { return m_struck; }

	const Settings& settings() const { return m_settings; }
	World& world() { return m_world; }
	const Parts& parts() const { return m_parts; }

private:
	void join();
	const Joint* notch() const;
	void substep(btScalar dt);
	void strike();
	double hammerEnergy() const;
	bool isHammerTouching() const;
	bool hasSlipped() const;
	double bendRate() const;
	void followBend();
	void hold();
	void observe();

	Settings m_settings;
	World m_world;
	Parts m_parts;
	Energy m_energy;
	std::vector<Joint> m_joints;
	Outcome m_outcome = Outcome::Swinging;
	Result m_result;           ///< what is not summed in m_energy
	double m_perJoule;         ///< Bullet's unit of energy over the joule
	double m_hammerLevel = 0;  ///< potential energy at rest at angle 0, Bullet's unit
	double m_specimenLevel = 0;
	double m_time = 0, m_struckTime = 0;
	std::vector<btTransform> m_seat;  ///< of the pieces before the blow
	double m_bend = 0;                ///< at the notch, followed through turns [rad]
	bool m_struck = false;
};
}  // namespace ep::charpy

#endif  // EP_CHARPY_IMPACT_TEST_H

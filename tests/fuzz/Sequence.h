// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_FUZZ_SEQUENCE_H
#define EP_FUZZ_SEQUENCE_H

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticStepControl.h"
#include "fuzz/Arena.h"
#include "fuzz/Chance.h"

/// Calls in random order to a world, its bodies, joints, action and solver, and what must be true after each of them. A legal
/// sequence does what a game may do; a hostile one also passes what makes no sense. Beside it stands a twin: the same world without
/// all that, whose quiet island has to have the same bits.
class Sequence : btElasticPlasticListener
{
public:
	/// \param isPool  in a world of Bullet's with threads
	Sequence(unsigned seed, bool isHostile, bool isPool);
	~Sequence() override;

	/// \return what is wrong; empty if nothing is
	std::string run();

private:
	struct Joint
	{
		std::unique_ptr<btTypedConstraint> m_constraint;
		btElasticPlasticJoint* m_joint;
		btRigidBody *m_a, *m_b;
		bool m_isOrphan;    ///< a body of it has been deleted: it may only be deleted, too
		bool m_isWeakened;  ///< has had another capacity, which its force may be far beyond
	};
	typedef void (Sequence::*Operation)();

	static const std::vector<Operation>& legal();
	static const std::vector<Operation>& hostile();

	// ---- legal
	void addBody();
	void removeBody();
	void deleteBodyAsBulletUsersDo();
	void addJoint();
	void deleteJoint();
	void forgetJoint();
	void addAgain();
	void repair();
	void changeCapacity();
	void changeJoint();
	void saveAndRestore();
	void push();
	void move();
	void makeKinematic();
	void step();
	void stepControlled();
	void changeThreads();
	void changeSettings();
	void changeListener();
	void replaceAction();
	void readEvents();
	void readAll();
	void takeSnapshot();
	void goBack();

	// ---- hostile
	void badCapacity();
	void badState();
	void badDofs();
	void badBody();
	void badStep();
	void badSettings();
	void badFrames();
	void joinToItself();
	void joinWithoutWorld();
	void takeBodyOut();
	void putBodyIn();
	void badSnapshot();

	// ---- the listener
	void onYield(const btElasticPlasticEvent& event) override { check(event); }
	void onBreak(const btElasticPlasticEvent& event) override;
	void onRefused(btElasticPlasticJoint&, const char* text) override { m_refusal = text; }
	void onBadStep(btScalar, const char*) override {}

	void makeBody(btScalar mass);
	void join(btRigidBody& a, btRigidBody& b, const btTransform& frameInA, const btTransform& frameInB,
			  const btElasticPlasticCapacity& capacity);
	btElasticPlasticCapacity capacity();
	btElasticPlasticCapacity capacityOfSprings();
	btElasticPlasticCapacity capacityWithFibres();
	btElasticPlasticMaterial materialOfFibres();
	void stepWorlds(btScalar dt, int most, btScalar fixed);
	void erase(size_t joint);
	void eraseBody(size_t body);
	void setAction(std::unique_ptr<btElasticPlasticAction> action);
	Joint* anyJoint();
	btRigidBody* anyBody();
	void check(const btElasticPlasticEvent& event);
	void checkAll();
	std::vector<unsigned char> snapshot();
	void complain(const std::string& what);

	Chance m_chance;
	const bool m_isHostile;
	const int m_form;  ///< 0 iterative, 1 stock, else direct
	Arena m_arena, m_twin;
	btBoxShape m_shape{btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5))};
	std::unique_ptr<btElasticPlasticAction> m_action;
	btElasticPlasticStepControl m_control;
	std::vector<std::unique_ptr<btRigidBody>> m_bodies;
	std::vector<Joint> m_joints;
	std::set<const btElasticPlasticJoint*> m_known;  ///< to the action
	bool m_deletesInListener = false;
	int m_numTold = 0;  ///< breaks at which the listener has done something
	bool m_hasTwin = true;
	std::vector<unsigned char> m_snapshot;  ///< empty: none
	std::string m_complaint;
	std::string m_refusal;  ///< what a listener has been told last
};

#endif  // EP_FUZZ_SEQUENCE_H

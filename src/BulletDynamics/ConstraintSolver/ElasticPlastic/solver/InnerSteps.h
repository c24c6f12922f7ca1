// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_INNER_STEPS_H
#define BT_ELASTIC_PLASTIC_INNER_STEPS_H

#include "../../btElasticPlasticSolverSettings.h"
#include "../../btElasticPlasticStatistics.h"
#include "../joint/OpenShare.h"
#include "../joint/StepKind.h"
#include "IslandState.h"
#include "StepParameters.h"

struct btContactSolverInfo;

namespace btElasticPlastic
{
/// Takes an island under a blow through several short steps within one step of the world, without collision detection.
///
/// An island is solved for the whole step first. What that leaves open (OpenShare) tells whether it was too long; if so, the island
/// goes back, and is taken through 2, 4, 8 ... inner steps, until none of them leaves more open than is allowed; from 32 on they become shorter within the step. Bodies' places,
/// contact points, joints' states, forces and penetration are brought along from one to the next. Then the bodies are put back with
/// their mean velocity for Bullet to move, and the joints' action puts them where the inner steps have ended (BodyMotion).
///
/// An island begins with as many inner steps as it had in the last step, and halves them when little has been left open for a while,
/// at a moment when velocities hardly depend on the step: else each change would take some energy out of an oscillation. While they are many it does
/// so within the step. One that needs none is solved as if there were none, to the bit.
class InnerSteps
{
public:
	/// Solves the island once.
	class Solution
	{
	public:
		/// \param maxWork  of this solution, as btElasticPlasticSolverSettings::m_maxWork
		virtual void solveStep(const btContactSolverInfo& info, StepKind kind, long long maxWork) = 0;

	protected:
		~Solution() {}
	};

	/// Whether the settings ask for inner steps, for islands that are not too large.
	static bool areAsked(const btElasticPlasticSolverSettings& settings);

	/// Whether there may be enough of them for what bounces: with fewer it is to touch before it does.
	static bool mayBounce(int numConstraints, const btElasticPlasticSolverSettings& settings);

	/// Solves an island for a step.
	void solve(const SolverGroup& island, const btContactSolverInfo& info,
			   const btElasticPlasticSolverSettings& settings, btElasticPlasticStatistics& statistics,
			   Solution& solution);

private:
	typedef btElasticPlasticState::InnerRhythm InnerRhythm;

	/// Of the island and step at work.
	struct Task
	{
		const SolverGroup& m_island;
		const btContactSolverInfo& m_info;
		const btElasticPlasticSolverSettings& m_settings;
		btElasticPlasticStatistics& m_statistics;
		Solution& m_solution;
		long long m_workBefore;
		int m_maxLevel;
		InnerRhythm m_rhythm = {};   ///< before the step
		bool m_isResolved = false;   ///< see JointRegistry::setStepControlled()
		bool m_keepsSwings = false;  ///< whether all its steps do, see StepKind
		double m_blow = 0;           ///< see IslandState::getEnergyOfBlow(); 0 where nothing rings
		// Of the present attempt:
		int m_numSolutions = 0;
		long long m_workAtBegin = 0, m_factorsAtBegin = 0;
		double m_workKept = 0;  ///< of inner steps that have not been taken back
		double m_left = 1;      ///< the share of the step that is ahead

		double getWorkOfAttempt() const { return double(m_statistics.m_work - m_workAtBegin); }

		/// The work of a solution that is no more than a factor.
		double getWorkOfFactor() const
		{
			return getWorkOfAttempt() /
				   btMax(double(m_statistics.m_factorisations - m_factorsAtBegin), double(m_numSolutions));
		}

		long long getWork() const { return m_statistics.m_work - m_workBefore; }
		/// Of the island's bound; an eighth of it is for what solutions take beyond theirs: each does at least one factorisation.
		long long getWorkLeft() const { return m_settings.m_maxWork - m_settings.m_maxWork / 8 - getWork(); }
	};

	/// To solve the step at a level.
	struct Attempt
	{
		double m_open;                  ///< the most that a step of it has left open and shorter steps would not
		double m_doubted;               ///< with what may be rounding
		double m_power, m_yieldEnergy;  ///< the largest of OpenShare's [W], [J]
		bool m_flows;                   ///< something has flowed
		bool m_isTaut;                  ///< joints are taut that were not, see JointStep::foreseeTension()
		bool m_isStruck;                ///< a blow has come within a step that is too long for any
		bool m_isLong;                  ///< more has been left open than is allowed, whether it counts or not
		bool m_isLeft;                  ///< the island goes back and begins again
		int m_next;                     ///< the level at which it does, else the last one
	};

	/// Successive inner steps of one length.
	struct Run
	{
		int m_level;
		double m_open = 0, m_doubted = 0;  ///< as of an attempt
		int m_calm = 0;                    ///< the last of them that have left little open
		bool m_isLoaded = false;           ///< see OpenShare
		int m_numSteps = 0;
		double m_workBefore;  ///< of the attempt

		Run(int level, double workBefore) : m_level(level), m_workBefore(workBefore) {}
		void add(const OpenShare& share, double error);
	};

	bool isStruck(const Task& task, int level) const;
	void take(Task& task, const JointRegistry& registry);
	Attempt solveWhole(Task& task);
	Attempt solveInner(Task& task, int level);
	bool beginsAgain(Task& task, const Run& run, int level, bool isTooDear, Attempt& attempt) const;
	void beginRun(Task& task, btScalar lengthOfLast, int level, Run& run);
	void setInnerLength(Task& task, btScalar ofVelocities, btScalar ofPoints, int level);
	static void solveInnerStep(Task& task, btScalar h, int ahead);
	void judge(const Task& task, btScalar h, Run& run, Attempt& attempt) const;
	bool mayBeLonger(const Task& task, const Run& run, btScalar longer);
	bool hasWorkForAnother(const Task& task) const;
	double expectWork(const Task& task, int from, int level) const;
	static double expectWorkAhead(const Task& task, int level);
	int mostLevel(const Task& task, int from, int level, bool goesOn) const;
	bool isTooMuch(const Task& task, const Run& run, int ahead) const;
	static bool mayGoOn(const Task& task);
	int refine(const Task& task, int level, const Attempt& attempt) const;
	bool isRinging(const Task& task, const Attempt& attempt) const;
	void findNext(const Task& task, int level, Attempt& attempt) const;
	static void limit(Attempt& attempt, double error);
	int beginLevel(Task& task);
	int affordableLevel(const Task& task, int level) const;
	void remember(const Task& task, int level, const Attempt& attempt) const;
	void rememberRinging(const Task& task, int level, const Attempt& attempt, InnerRhythm& rhythm) const;

	IslandState m_state;
	StepParameters m_parameters;
	std::vector<BodyMotion> m_motions;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_INNER_STEPS_H

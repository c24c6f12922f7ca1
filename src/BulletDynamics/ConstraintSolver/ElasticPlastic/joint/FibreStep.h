// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_FIBRE_STEP_H
#define BT_ELASTIC_PLASTIC_FIBRE_STEP_H

#include <vector>

#include "CoupledBundle.h"
#include "JointModel.h"
#include "JointRows.h"
#include "MaterialDamping.h"
#include "SectionStiffness.h"
#include "ShearInteraction.h"

namespace btElasticPlastic
{
/// The fibres of a joint in one step. They stand for its axial row and its two rows of bending, for a solver that solves all rows
/// together.
///
/// A fibre's elongation is that of its place in the section, e + z a_y - y a_z in the mid frame, less its own plastic offset. Its row is
/// that of Law.h, with bounds from its strengths in tension and in compression. All fibres have one alpha and beta, and so have the shears
/// where these are coupled with bending: those of the axial row, the fastest, so that what a step does not resolve dies out. In inner steps that would
/// take most of a bending that rings after a blow before it is flow. There it is the mean of all rows' frequencies, in their logarithms, weighted by how
/// much of the joint's motion is in each; but that of the axial row where the step elongates the section further than it resolves, or a fibre bears
/// pressure only: it opens by whatever it moves, and a force that the step knows from its beginning would work on all of that.
///
/// In the many inner steps of a blow fibres are by mode, and so are the shears that are coupled with them, but where one bears pressure only or its strength changes in the step.
/// Of the mean forces of the last two steps those of the section are kept: a fibre's are taken to differ from its present force as they would in an elastic section.
/// At the end of a step it bears no more than its strength, whatever the scheme.
///
/// The offsets of fibres have no mean: what they have in common is the joint's plastic deformation, by which the reference moves.
///
/// The material's damping acts on each fibre as on a spring, with branches whose forces follow the fibre's and relax. At the end of a step only
/// what they add up to over the section is kept, N, M_y and M_z of each branch, and the next one finds of it the fibres' shares, as of a section that
/// is elastic: these are the least energy with that sum. So nothing is left out while no fibre flows, and what is, is dissipated.
class FibreStep
{
public:
	/// \param damping  that of the step
	/// \param yield    yield values in the step, before fibres and shears take of each other
	FibreStep(JointModel& model, const MaterialDamping& damping, const btScalar (&yield)[BT_EP_DOF_COUNT])
		: m_model(model), m_damping(damping), m_yield(yield)
	{
	}

	/// Has the processor load what a step's beginning and its end use of the fibres, whose memory lies elsewhere.
	void prefetch() const;
	/// What setSolution() uses.
	void prefetchForSolution() const;

	/// How the step begins.
	struct Motion
	{
		btScalar m_rate[BT_EP_DOF_COUNT];  ///< of strain
		btScalar m_turn[2];                ///< A of the two rows of bending
		btScalar m_lastStep;               ///< 0: none [s]
		bool m_isInner;                    ///< the step is shorter than the world's
		bool m_keepsSwings;                ///< see StepKind
		btScalar m_tau;                    ///< of the section's past, see MeanForce::tauOfWaves()
	};

	/// Before all rows of the step are made: what shears and torsion leave of the fibres and of each other.
	void beginShear(const Motion& motion, btScalar dt) { m_interaction.find(m_model, m_yield, motion.m_rate, dt); }
	/// The yield value of a shear or torsion in the step.
	btScalar yieldOf(int dof) const { return m_interaction.getShare(dof) * m_yield[dof]; }

	/// Makes the fibres' rows, and couples them with those of the shears.
	/// \param strain    of the joint's six degrees of freedom, as the step meets it
	/// \param motion    by which it grows
	/// \param diagonal  A of the axial row
	/// \param rows      with the rows of the other degrees of freedom; gets the fibres
	void begin(const btScalar strain[BT_EP_DOF_COUNT], const Motion& motion, btScalar diagonal, btScalar dt,
			   JointRows& rows);

	/// What the solver has made of the fibres' rows.
	/// \param isCut      as commit() is going to be told
	/// \param resultant  gets N, M_y and M_z over the step, as impulses
	void setSolution(const double* impulses, const signed char* bounds, bool isCut, btScalar resultant[3]);

	/// Return mapping of the step, of the section as a whole.
	struct Outcome
	{
		btScalar m_force[3] = {};      ///< N, M_y, M_z at the end of the step
		btScalar m_increment[3] = {};  ///< of the joint's plastic deformation: elongation, turns about y and z
		double m_plasticEnergy = 0;
		bool m_flowed = false;
		bool m_hasMoved = false;   ///< an offset has changed
		bool m_isCoupled[2] = {};  ///< whether the shears' mapping follows from the fibres' one, as given here
		ReturnMapping m_shear[2];
		// Of the damping's branches:
		SectionForces m_branch[MaterialDamping::BRANCHES];  ///< at the end of the step
		double m_squares[MaterialDamping::BRANCHES] = {};   ///< sum of q0^2 + q0 q1 + q1^2, over k
		double m_lost = 0;                                  ///< energy of what is not kept, see the class [J]
	};

	/// Maps all fibres, and changes their state.
	/// \param trial   deformation of the six degrees of freedom if the whole step was elastic
	/// \param shears  of the two shears, null: no row
	/// \param isCut   the impulses are of a search that has been cut: then all flow is given up
	Outcome commit(const btScalar trial[BT_EP_DOF_COUNT], const RowOutcome* const shears[2], bool isCut);

	/// A piece of the section that has cracked or ruptured.
	struct Loss
	{
		int m_fibre;  ///< the last of the piece's layers
		bool m_isRuptured;
		double m_share;  ///< of the step's flow, at which it went
	};

	/// Of the step.
	int getNumFibres() const { return m_numFibres; }

	/// In the order in which they went, since they were forgotten.
	const btAlignedObjectArray<Loss>& getLosses() const { return m_losses; }
	void forgetLosses() { m_losses.resize(0); }

	/// Whether the step's fibres are by mode, and the shear that is coupled with them, if this one is.
	bool areOfWaves() const { return m_areOfWaves; }
	bool isCoupled(int row) const { return row == m_shearRow[0] || row == m_shearRow[1]; }

	/// Whether a fibre is at a bound of its impulse.
	bool isAnyAtBound() const { return m_isAnyAtBound; }

	/// By fibre: -1, 0 or 1. The next step's search for the fibres at their bounds begins with them.
	std::vector<signed char> getLastBounds() const;
	void setLastBounds(const std::vector<signed char>& bounds);
	/// Of fibres that there are no more.
	void forgetLastBoundsBeyond(int numFibres)
	{
		if (m_bound.size() <= numFibres)
			return;
		m_bound.resize(numFibres);
		lookForBounds();
	}

private:
	/// All the damping's branches at the start of the step, as planes of the section.
	struct Branches
	{
		btScalar m_stiffening = 0;  ///< see DofState
		SectionPlaneOf<btScalar> m_force, m_carried;

		/// Adds a fibre's share. \param bore  see JointModel::bears()
		void addTo(DofState& s, const JointModel::BearingFibre& fibre, bool bore) const
		{
			const btScalar stiffness = bore ? fibre.m_stiffness : btScalar(0);
			s.m_stiffening = m_stiffening;
			s.m_carried = m_carried.at(fibre) * stiffness - m_stiffening * s.m_force;
			s.m_force += m_force.at(fibre) * stiffness;
		}
	};
	struct Mapped
	{
		double m_force;      ///< of the spring
		double m_total;      ///< with the damping's branches
		double m_increment;  ///< of plastic elongation; of a crack: by which it gapes
		double m_unloaded;   ///< given up, neither elastic nor plastic
		btScalar m_change;   ///< of the spring's force in the step, once its state is taken
	};

	/// What is known of fibres' mean forces by mode: a share of their forces at the beginning of the step, and a plane.
	struct Past
	{
		btScalar m_own;
		SectionPlaneOf<btScalar> m_plane;
	};

	void lookForBounds();
	/// Whether a fibre bore at the start of the step, see JointModel::bears().
	bool bore(int fibre) const { return m_boreAll || m_bore[fibre]; }
	DofState stateOf(int fibre, const SectionPlaneOf<btScalar>& plane) const;
	DofState stateOf(int fibre, const btScalar strain[BT_EP_DOF_COUNT]) const;
	DofState stateOfShear(int shear, const btScalar strain[BT_EP_DOF_COUNT]) const;
	double couplingOf(int fibre, int shear) const;
	void findCoupledRows(const JointRows& rows);
	void findBearing();
	void findBranches();
	const SectionCompliance& compliance() const { return m_boreAll ? m_model.getWholeCompliance() : m_partCompliance; }
	bool carriesWaves(const Motion& motion) const;
	Past pastOf(const MeanForce& scheme) const;
	btScalar knownByMode(int fibre, const Past& past, btScalar force, const JointModel::FibreStrength& strength) const;
	void couple(const btScalar strain[BT_EP_DOF_COUNT], const MeanForce& scheme, btScalar a, JointRows& rows);
	bool takeElastic(const btScalar trial[BT_EP_DOF_COUNT], Outcome& outcome);
	void mapAlone(const btScalar trial[BT_EP_DOF_COUNT]);
	void mapCoupled(const btScalar trial[BT_EP_DOF_COUNT], const RowOutcome* const shears[2], Outcome& outcome);
	void mapCut(const btScalar trial[BT_EP_DOF_COUNT], const RowOutcome* const shears[2], Outcome& outcome);
	struct Strength : JointModel::FibreStrength
	{
		btScalar m_rate, m_rateShare;  ///< see btElasticPlasticFibreState
	};

	btScalar elongationOverYield(const Motion& motion) const;
	/// That by which the scheme is chosen. \param diagonal  A of the axial row
	btScalar squareOfFrequency(const Motion& motion, btScalar diagonal, const JointRows& rows) const;
	void findResponse(const Motion& motion, btScalar diagonal);
	double rateShareInStep(int fibre, double force, double rate, const JointModel::FibreStrength& strength) const;
	double flowInStep(int fibre, bool isPulled, double beyond, double stiffness, double stronger) const;
	double tearingStrength(int fibre, const DofState& s, double elongation, double strength, double end,
						   double alpha) const;
	Strength strengthInStep(int fibre, const DofState& s, const Motion& motion, btScalar alpha) const;
	Strength steadyStrength(int i, const JointModel::BearingFibre& fibre,
							const btElasticPlasticFibreState& state) const;
	void findSteadyStrengths();
	bool isOpen(int fibre) const { return m_mapped[fibre].m_increment > 0 && m_model.bearsPressureOnly(fibre); }
	double flowForce(int fibre) const;
	void letGo(int fibre);
	bool isGaping(int fibre) const;
	double stretchOf(int fibre) const;
	void flow(int fibre, double force, double increment, Outcome& outcome);
	double crack(int fibre, double increment, double damage);
	void damp(Outcome& outcome);
	void dampTogether(const SectionForces& change, Outcome& outcome);
	void dampEach(Outcome& outcome);
	void takeStates(const btScalar trial[BT_EP_DOF_COUNT], Outcome& outcome);
	void finish(const btScalar trial[BT_EP_DOF_COUNT], bool isCut, Outcome& outcome);
	void tearApart(Outcome& outcome);
	void noteLoss(int fibre, double share);
	void takeMean(btScalar mean[3]);

	// What an elastic step asks for, close together.
	JointModel& m_model;
	const MaterialDamping& m_damping;
	const btScalar (&m_yield)[BT_EP_DOF_COUNT];
	btScalar m_dt = 0;
	int m_numFibres = 0;
	int m_shearRow[2] = {-1, -1};  ///< of the joint's rows that are coupled with the fibres, -1: none
	bool m_areOfWaves = false;     ///< by mode, see the class
	bool m_boreAll = true;         ///< see bore()
	Branches m_branches;           ///< the damping's
	SectionPlane m_branch[MaterialDamping::BRANCHES];  ///< of each of them, with more digits
	bool m_isAnyAtBound = false;                       ///< of m_bound, whose memory lies elsewhere
	btAlignedObjectArray<signed char> m_bound;         ///< of the last solution
	ShearInteraction m_interaction;                    ///< begins with such things, too
	// The rest is for others.
	btAlignedObjectArray<bool> m_bore;          ///< see bore()
	SectionCompliance m_partCompliance;         ///< of what bore, if not all did
	btAlignedObjectArray<btScalar> m_impulse;   ///< of a search that has been cut
	btAlignedObjectArray<btScalar> m_known;     ///< c of Law.h, of fibres that are coupled with shears
	btAlignedObjectArray<Strength> m_strength;  ///< for the step; not made of fibres that are steady until one flows
	double m_response[3];                       ///< of elongation and turns to strength, see findResponse()
	btAlignedObjectArray<Mapped> m_mapped;
	CoupledBundle m_bundle;
	btAlignedObjectArray<Loss> m_losses;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_FIBRE_STEP_H

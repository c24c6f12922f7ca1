// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SOLVER_SETTINGS_H
#define BT_ELASTIC_PLASTIC_SOLVER_SETTINGS_H

#include "btElasticPlasticFault.h"

/// How islands with elastic-plastic joints are solved.
enum btElasticPlasticForm : int  // of a fixed type: a value that is none can be passed, and is refused
{
	BT_EP_DIRECT,    ///< exactly, by a sparse factorisation, contacts and other constraints included
	BT_EP_ITERATIVE  ///< by Bullet's sequential impulses with exact soft rows: as good as its iterations
};

/// How the direct form solves the contacts of an island with elastic-plastic joints.
enum btElasticPlasticContacts : int
{
	/// Exactly, up to btElasticPlasticSolverSettings::m_maxExactContacts points, and swept if there are more.
	BT_EP_CONTACTS_BY_ISLAND,
	/// With the joints, as exactly as these. The cost grows with the number of contacts, and more than that where many slide.
	BT_EP_EXACT_CONTACTS,
	/// As Bullet sweeps them, btContactSolverInfo::m_numIterations times, with a solution of the joints after every fifth sweep (every
	/// second one in a structure of up to 30 bodies) and at the end. As good as Bullet's contacts are; joints are exact for the contacts' impulses.
	BT_EP_SWEPT_CONTACTS
};

/// All settings of btElasticPlasticConstraintSolver, assigned by value.
struct btElasticPlasticSolverSettings
{
	/// To be chosen once: iterations that have not converged leave strain in the joints, to which the direct form gives its
	/// full force.
	btElasticPlasticForm m_form = BT_EP_DIRECT;

	/// How many threads solve islands at the same time, the calling one included, 1 to MAX_THREADS. For small islands with
	/// elastic-plastic joints, direct form only; it pays from some dozens of them, in worlds with setSplitIslands(false), or
	/// Bullet hands over few at a time. The number of threads changes no bit of the result.
	int m_numThreads = 1;

	// ---- the direct form

	/// The most Newton steps of the search for the rows at their bounds, >= 0. A search that would take more is cut, and the statistics
	/// count it (btElasticPlasticStatistics::m_cutSearches): impulses then obey their bounds and gain no energy, but are not exact.
	int m_maxNewtonSteps = 200;

	/// The most iterations of the interior point method that takes over where Newton's steps become short, >= 0; 0: it never does.
	/// Less than 15 makes blows less exact.
	int m_maxInteriorIterations = 40;

	btElasticPlasticContacts m_contacts = BT_EP_CONTACTS_BY_ISLAND;

	/// The most contact points of an island that are solved exactly, >= 0, with BT_EP_CONTACTS_BY_ISLAND.
	int m_maxExactContacts = 24;

	/// The most rounds of the augmented Lagrangian that makes contacts hard, >= 0: each gains about two digits.
	int m_maxContactLoops = 20;

	/// Contacts are exact when what they still slip or penetrate is below this, relative to the fastest approach, > 0.
	double m_contactTolerance = 1e-3;

	/// Whether the search in a large island, such as a wall of 800 bodies or a cube of 350, runs only where rows reach or leave their bounds: around contacts and
	/// flowing joints. The result is the same up to rounding.
	bool m_condenses = true;

	/// The most work for an island in a step, in the unit of btElasticPlasticStatistics::m_work, >= 0; 0: no limit. A search that would take
	/// more is cut (m_cutSearches): impulses obey their bounds and gain no energy, but are not exact. The same program gives the same
	/// bits, as work is counted and not timed. At least one factorisation and one solution are done.
	long long m_maxWork = 0;

	// ---- inner steps: an island under a blow is taken through several short ones within a step of the world

	/// The error allowed in how much flows in a step, 0 to 1, as btElasticPlasticStepControl has it: an island whose step leaves more
	/// open is taken through inner steps. 0: none is, and none in a btConstraintSolverPoolMt and in the substeps of a step control.
	/// Collision detection and the rest of the world have one step. With the default most blows keep to 5 % (docs/solver.md).
	double m_innerError = 0.04;

	/// The most inner steps of a step, 1 to 4096, of which the largest power of two is taken. Where more were needed, the error is larger.
	int m_maxInnerSteps = 1024;

	/// The work for the inner steps of an island in a step, in the unit of btElasticPlasticStatistics::m_work, > 0: a large
	/// island takes fewer, and none if there is not the work for eight, which are 4000 by constraint and 1328 by contact point at the least: none of
	/// more than 500 constraints, or of 250 with 750 points, with the default, 2 ms of a processor of 3 GHz. It is what solutions take; making their rows and moving
	/// the bodies, about 1.2 microseconds by body and inner step, come on top. In a blow it may be a few times as much, but for m_maxWork, which bounds it, too;
	/// the next step has fewer then.
	long long m_maxInnerWork = 2000000;

	/// Whether structures keep their swings: a load that comes on at once, or a base that shakes, makes a structure flow by what it swings beyond its equilibrium. By default steps of the
	/// world damp a swing of 12 of them by a quarter of the critical damping, and of 50 of them by 6 %, so that damage is missing, up to all of it. With this, what steps do not
	/// resolve is damped by the mode's frequency, with inner steps or without, in islands that nothing touches, whose joints all have a material that damps and are not taut,
	/// and on which no springs or motors of Bullet's act; not under a step control. Structures then swing until the material's damping has brought them to rest, and single steps tell
	/// up to half a step's power more or less elastic energy than there is (docs/solver.md).
	bool m_keepsSwings = false;

	/// The factor that a large island kept from the last step is used as long as so few iterations of conjugate gradients with it
	/// are enough, >= 0; 0: never.
	int m_maxIterations = 8;

	/// Residual at which these iterations end, relative to the right side, > 0.
	double m_iterationTolerance = 1e-11;

	/// The widest vectors that the factorisation may use, in doubles: 1, 2, 4 or 8; the processor may have less. All processors that
	/// fuse multiplication and addition (x86-64 with AVX2 and FMA) give the same bits by 2, 4 and 8. By 1 they do not fuse, and
	/// agree with those that cannot, at up to twice the time.
	int m_maxVectorWidth = 8;

	/// Whether the statistics tell where the time goes (btElasticPlasticStatistics::m_setUpTime and those after it). Reading the clock takes a few per cent of a step
	/// in a world of many small islands.
	bool m_measuresTime = false;

	static constexpr int MAX_THREADS = 64;
	static constexpr int MAX_INNER_STEPS = 4096;

	/// First setting that is out of its range.
	btElasticPlasticFault fault() const;
};

#endif  // BT_ELASTIC_PLASTIC_SOLVER_SETTINGS_H

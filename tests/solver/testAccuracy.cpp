// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The direct form against structural mechanics: static sag, limit loads, a travelling plastic hinge.

#include <math.h>

#include <algorithm>

#include <gtest/gtest.h>

#include "scenes/Cantilever.h"
#include "support/DirectSolver.h"
#include "scenes/HangingChain.h"
#include "scenes/LoadedBeam.h"
#include "scenes/ParkesCantilever.h"
#include "scenes/PortalFrame.h"
#include "support/Precision.h"
#include "support/Run.h"

namespace testAccuracy
{
using namespace ep;

TEST(Accuracy, CantileverSettlesAtItsStaticSag)
{
	for (JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
		for (int parts : {10, 30, 100})
		{
			SCOPED_TRACE(testing::Message() << "class " << int(jointClass) << " parts " << parts);
			Cantilever::Settings settings;
			settings.member.parts = parts;
			settings.method.jointClass = jointClass;
			Cantilever cantilever(settings);
			run(cantilever.m_world, 60);
			// Sagging by 5e-4 of the length leaves its square to small deflections; measured 2e-7 in double, 4e-7 in float.
			EXPECT_NEAR(1, double(cantilever.sag()) / cantilever.staticSag(), 1e-5);
			EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_fallbacks);
		}
}

TEST(Accuracy, CantileverSettlesInATurnedScene)
{
	Cantilever::Settings settings;
	settings.turn = btQuaternion(btVector3(1, 2, -2).normalized(), btScalar(0.7));
	Cantilever cantilever(settings);
	run(cantilever.m_world, 60);
	// In float a joint's 1e-5 rad are the difference of two orientations that are rounded at 6e-8.
	EXPECT_NEAR(1, double(cantilever.sag()) / cantilever.staticSag(), byPrecision(1e-5, 1e-3));
}

TEST(Accuracy, StaticSagOfRigidPartsTendsToTheBeams)
{
	for (int parts : {10, 30, 100})
	{
		Cantilever::Settings settings;
		settings.member.parts = parts;
		// One rigid part more or less at the root: the error falls with the square of their number.
		Cantilever cantilever(settings);
		EXPECT_NEAR(1, cantilever.staticSag() / cantilever.beamSag(), 1.1 / (parts * parts));
	}
}

TEST(Accuracy, TwentyBlocksSwingAboutTheirStaticSag)
{
	for (int rate : {60, 240})
	{
		Cantilever cantilever(Cantilever::Settings::twentyBlocks());
		EXPECT_NEAR(0.5865, cantilever.staticSag(), 1e-4);
		std::vector<double> sag;
		for (int i = 0; i < 20 * rate; ++i)
		{
			cantilever.m_world.step(btScalar(1) / rate);
			sag.push_back(double(cantilever.sag()));
		}
		// Whole periods: from the first to the last time that it sinks past its static place.
		size_t first = 0, last = 0;
		for (size_t i = 1; i < sag.size(); ++i)
			if (sag[i - 1] < cantilever.staticSag() && sag[i] >= cantilever.staticSag())
			{
				first = first ? first : i;
				last = i;
			}
		ASSERT_GT(last, first);
		double mean = 0;
		for (size_t i = first; i < last; ++i)
			mean += sag[i] / double(last - first);
		// The oscillation decays, and each period begins with its deeper half: 0.6 % at 1/60, 0.3 % at 1/240.
		EXPECT_NEAR(1, mean / cantilever.staticSag(), 0.01) << rate;
		for (const btElasticPlasticJoint* joint : cantilever.m_world.joints())
			EXPECT_FALSE(joint->hasYielded());
	}
}

TEST(Accuracy, ChainHoldsAThousandTimesItsBlocks)
{
	for (JointClass jointClass : {JointClass::Spring, JointClass::Spring2})
	{
		HangingChain::Settings settings;
		settings.method.jointClass = jointClass;
		HangingChain chain(settings);
		run(chain.m_world, 120);
		// In float the stretch of 0.5 mm is the difference of places 3 m down, which are rounded at 1.2e-7 m each step.
		EXPECT_NEAR(1, double(chain.stretch()) / chain.staticStretch(), byPrecision(1e-6, 1e-3));
	}
}

// ---- limit loads

/// Puts a load on within a second and holds it for two more.
template <class Load>
void loadSlowly(World& world, const Load& load)
{
	for (int i = 0; i < 180; ++i)
	{
		load(std::min(1., (i + 1) / 60.));
		world.step(FRAME);
	}
}

struct BeamUnderLoad : LoadedBeam
{
	/// \param factor  of the collapse load
	BeamUnderLoad(Supports supports, double factor) : LoadedBeam(settingsOf(supports))
	{
		loadSlowly(m_world, [this, factor](double share) { load(factor * share * collapseLoad()); });
	}

	static Settings settingsOf(Supports supports)
	{
		Settings settings;
		settings.supports = supports;
		return settings;
	}
};

TEST(Accuracy, BeamsStandBelowTheirCollapseLoad)
{
	for (LoadedBeam::Supports supports :
		 {LoadedBeam::Supports::Fixed, LoadedBeam::Supports::Propped, LoadedBeam::Supports::Simple})
	{
		BeamUnderLoad beam(supports, 0.99);
		// Elastic, the simply supported beam sinks most, by P L^3 / 48 E I = Mp L^2 / 12 E I.
		const double elastic = beam.plasticMoment() * 16 / 12 / (200e9 * 1e-4 / 12);
		EXPECT_LT(double(beam.sag()), 1.1 * elastic) << int(supports);
		// At rest: a beam of 314 kg that creeps with 1e-4 m/s has 1e-6 J.
		EXPECT_LT(beam.m_world.kineticEnergy(), 1e-6) << int(supports);
		EXPECT_EQ(0, statisticsOf(beam.m_world).m_fallbacks);
	}
}

TEST(Accuracy, BeamsCollapseAboveTheirCollapseLoad)
{
	for (LoadedBeam::Supports supports :
		 {LoadedBeam::Supports::Fixed, LoadedBeam::Supports::Propped, LoadedBeam::Supports::Simple})
	{
		BeamUnderLoad beam(supports, 1.01);
		// As a mechanism it falls until its arms are so steep that the load bends them less: beyond any elastic sag.
		EXPECT_GT(double(beam.sag()), 1) << int(supports);
		// One hinge at mid span, and those of the ends.
		int hinges = 0;
		for (const btElasticPlasticJoint* joint : beam.m_world.joints())
			hinges += joint->getPlasticPath(BT_EP_BENDING_Z) > 0.1;
		EXPECT_EQ(supports == LoadedBeam::Supports::Fixed     ? 3
				  : supports == LoadedBeam::Supports::Propped ? 2
															  : 1,
				  hinges);
		EXPECT_GT(beam.m_middle->getPlasticPath(BT_EP_BENDING_Z), 0.1);
	}
}

/// Loads that make each of the portal's mechanisms the first, as multiples of Mp/L and Mp/h.
const double PORTAL_LOADS[][2] = {{8, 0}, {0, 4}, {6, 3}};

TEST(Accuracy, PortalStandsBelowItsCollapseLoads)
{
	for (const double* loads : PORTAL_LOADS)
	{
		PortalFrame portal{PortalFrame::Settings()};
		const double v = loads[0] * portal.plasticMoment() / 4, h = loads[1] * portal.plasticMoment() / 3;
		const double factor = 0.99 * portal.collapseFactor(v, h);
		EXPECT_NEAR(0.99, factor, 1e-5);
		loadSlowly(portal.m_world,
				   [&portal, factor, v, h](double share) { portal.load(share * factor * v, share * factor * h); });
		// Elastic and partly plastic it gives by half a centimetre.
		EXPECT_LT(double(portal.sag() + portal.sway()), 0.01);
		// At rest: 13 t that creep with 1e-4 m/s have 6e-5 J.
		EXPECT_LT(portal.m_world.kineticEnergy(), 1e-5);
		EXPECT_EQ(0, statisticsOf(portal.m_world).m_fallbacks);
	}
}

TEST(Accuracy, PortalCollapsesAboveItsCollapseLoads)
{
	for (const double* loads : PORTAL_LOADS)
	{
		PortalFrame portal{PortalFrame::Settings()};
		const double v = loads[0] * portal.plasticMoment() / 4, h = loads[1] * portal.plasticMoment() / 3;
		const double factor = 1.01 * portal.collapseFactor(v, h);
		for (int i = 0; i < 180 && double(portal.sag() + portal.sway()) < 0.5; ++i)
		{
			const double share = std::min(1., (i + 1) / 60.);
			portal.load(share * factor * v, share * factor * h);
			portal.m_world.step(FRAME);
		}
		const double sag = portal.sag(), sway = portal.sway();
		EXPECT_GT(sag + sway, 0.5);
		// The mechanism meant: mid beam goes down with the beam and with both, the corner sideways when swaying and with both.
		EXPECT_EQ(loads[0] > 0, sag > sway / 4);
		EXPECT_EQ(loads[1] > 0, sway > sag / 4);
	}
}

// ---- the travelling hinge

/// Mean over the last third of the time, in which the tip swings elastically about where it stays.
struct Rest
{
	double m_tip = 0, m_rootRotation = 0;

	Rest(ParkesCantilever& cantilever, double dt, double time)
	{
		const int steps = int(time / dt + 0.5), from = steps * 2 / 3;
		for (int i = 0; i < steps; ++i)
		{
			cantilever.m_world.step(btScalar(dt));
			if (i < from)
				continue;
			m_tip += cantilever.tip() / (steps - from);
			m_rootRotation += cantilever.rootRotation() / (steps - from);
		}
	}
};

TEST(Accuracy, ParkesCantileverBendsAsWithTinySteps)
{
	ParkesCantilever cantilever{ParkesCantilever::Settings()};
	EXPECT_NEAR(10, cantilever.energyRatio(), 0.01);
	const Rest rest(cantilever, 1. / 3840, 0.12);
	// This solver with steps of 1 us, good for half a per cent: tip 0.637 m, root 0.532 rad. (Parkes' own formula, for small deflections and
	// without elasticity, gives 0.582 m.)
	EXPECT_NEAR(1, rest.m_tip / 0.637, 0.04);
	// The hinge reaches the root early by half a step's travel of some parts: measured 5.7 %.
	EXPECT_NEAR(1, rest.m_rootRotation / 0.532, 0.08);
	RecordProperty("rootMilliradians", int(1e3 * rest.m_rootRotation));
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_fallbacks);
}

TEST(Accuracy, StiffCantileverBendsAsParkesSays)
{
	// 500 times stiffer than steel, so that elastic waves outrun the hinge, and a gentle blow.
	ParkesCantilever::Settings settings;
	settings.member.material.m_youngsModulus = btScalar(1e14);
	settings.velocity = 10;
	ParkesCantilever cantilever(settings);
	const Rest rest(cantilever, 1. / 15360, 0.06);
	// Twenty parts: the hinge travels in leaps, and the tip's box turns with the first: 3 and 8 % measured.
	EXPECT_NEAR(1, rest.m_tip / cantilever.exactTip(), 0.05);
	EXPECT_NEAR(1, rest.m_rootRotation / cantilever.exactRootRotation(), 0.12);
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_fallbacks);
}

// Newton's line search crawls where rows are all but rigid: 50 steps do not find which of the 20 hinges flow.
TEST(Accuracy, RigidPlasticCantileverBendsAsParkesSays)
{
	ParkesCantilever::Settings settings;
	settings.rigidPlastic = true;
	settings.velocity = 10;
	ParkesCantilever cantilever(settings);
	const Rest rest(cantilever, 1. / 3840, 0.06);
	// As the stiff one above; a quarter of the steps.
	EXPECT_NEAR(1, rest.m_tip / cantilever.exactTip(), 0.06);
	EXPECT_NEAR(1, rest.m_rootRotation / cantilever.exactRootRotation(), 0.15);
	EXPECT_EQ(0, statisticsOf(cantilever.m_world).m_fallbacks);
}
}  // namespace testAccuracy

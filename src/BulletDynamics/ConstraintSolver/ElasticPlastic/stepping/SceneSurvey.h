// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_SCENE_SURVEY_H
#define BT_ELASTIC_PLASTIC_SCENE_SURVEY_H

#include "LinearMath/btAlignedObjectArray.h"

class btElasticPlasticJoint;

namespace btElasticPlastic
{
/// What has to be known of a world in order to tell which parts of its computation can be left out.
struct SceneSurvey
{
	int m_joints = 0;
	int m_bodies = 0;     ///< moving bodies with joints
	int m_depth = 0;      ///< joints from a support to the body farthest from it; without supports: 0
	int m_stiff = 0;      ///< degrees of freedom whose period is shorter than two steps
	int m_springs = 0;    ///< degrees of freedom that spring
	int m_endless = 0;    ///< degrees of freedom that never yield
	int m_colliding = 0;  ///< joined bodies that may touch others
	double m_shortest = SIMD_INFINITY, m_longest = 0;  ///< periods of single degrees of freedom [s]
	double m_massRatio = 1;                            ///< the largest ratio of two neighbours' masses
	double m_slenderness = 0;                          ///< the largest ratio of a body's longest edge to its shortest
};

/// Surveys an action's joints that are not broken, and their bodies.
/// \param step  of the game [s]
SceneSurvey surveyScene(const btAlignedObjectArray<btElasticPlasticJoint*>& joints, double step);
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_SCENE_SURVEY_H

// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_INNER_RHYTHM_H
#define BT_ELASTIC_PLASTIC_INNER_RHYTHM_H

namespace btElasticPlastic
{
/// In how many inner steps a joint's island has taken the last step. Islands join and part; their joints remember it.
struct InnerRhythm
{
	unsigned char m_level = 0;  ///< 1 << m_level inner steps
	unsigned char m_calm = 0;   ///< successive steps that have left little open
	unsigned char m_spare = 0;  ///< by so many levels less they would all have left less than half of the error allowed
	unsigned char m_quiet = 0;  ///< successive steps in which nothing has flowed, as far as they count, see InnerSteps
	float m_ringing = 0;        ///< how fast joints have moved meanwhile, see OpenShare::getPower() [W]
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_INNER_RHYTHM_H

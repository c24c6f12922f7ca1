// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_LEVELS_H
#define BT_ELASTIC_PLASTIC_LEVELS_H

#include "../../btElasticPlasticEvent.h"
#include "../../btElasticPlasticCapacity.h"

namespace btElasticPlastic
{
/// The levels of a joint's quantities of which the user wants to hear. Which of them have been passed is kept in the joint's state.
class Levels
{
public:
	static bool isLevel(btScalar level)
	{
		return btElasticPlasticIsFinite(level) && level > 0 && level <= btElasticPlasticCapacity::unlimited();
	}

	/// \return whether the quantity is one and the level in its range
	bool set(btElasticPlasticQuantity quantity, btScalar level)
	{
		if (!isQuantity(quantity) || !isLevel(level))
			return false;
		m_level[quantity] = level;
		m_isAnySet = false;
		for (btScalar each : m_level)
			m_isAnySet |= each < btElasticPlasticCapacity::unlimited();
		return true;
	}

	btScalar get(btElasticPlasticQuantity quantity) const
	{
		return isQuantity(quantity) ? m_level[quantity] : btElasticPlasticCapacity::unlimited();
	}

	bool isAnySet() const { return m_isAnySet; }

	/// Whether a quantity has just risen to its level.
	/// \param passed  the state's bits, of which the quantity's is set while it is passed
	bool pass(btElasticPlasticQuantity quantity, btScalar value, unsigned& passed) const
	{
		const unsigned bit = 1u << quantity;
		const bool wasPassed = (passed & bit) != 0, isPassed = value >= m_level[quantity];
		if (isPassed)
			passed |= bit;
		else if (value < REARM_SHARE * m_level[quantity])
			passed &= ~bit;
		return isPassed && !wasPassed;
	}

private:
	/// Of a level: a value that trembles about it is told once.
	static constexpr btScalar REARM_SHARE = btScalar(0.9);

	static bool isQuantity(btElasticPlasticQuantity quantity)
	{
		return int(quantity) >= 0 && int(quantity) < int(BT_EP_QUANTITY_COUNT);
	}

	btScalar m_level[BT_EP_QUANTITY_COUNT] = {
		btElasticPlasticCapacity::unlimited(), btElasticPlasticCapacity::unlimited(),
		btElasticPlasticCapacity::unlimited(), btElasticPlasticCapacity::unlimited()};
	bool m_isAnySet = false;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_LEVELS_H

// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_GAP_LIST_H
#define BT_ELASTIC_PLASTIC_GAP_LIST_H

#include "LinearMath/btAlignedObjectArray.h"

namespace btElasticPlastic
{
/// A list in the order of arrival, from which each element can be removed: both take constant time on average, and the memory
/// is in proportion to the largest number of elements that there were at a time.
///
/// What is removed between others leaves a gap. Gaps are closed when they are more than the elements, or when asked for. An
/// element is told its index whenever that changes.
///
/// \tparam T  has void setIndex(int), bool isGap() const and void makeGap()
template <class T>
class GapList
{
public:
	/// The number of elements.
	int getCount() const { return m_count; }

	/// The end of indices. There may be gaps before it.
	int getEnd() const { return m_elements.size(); }
	T& operator[](int index) { return m_elements[index]; }

	/// The n-th element. Constant time as long as elements are removed at the ends only.
	T& get(int n)
	{
		if (m_begin + m_count != getEnd())
			closeGaps();
		return m_elements[m_begin + n];
	}

	void append(const T& element)
	{
		if (getEnd() - m_count > m_count)
			closeGaps();
		m_elements.push_back(element);
		++m_count;
		m_elements[getEnd() - 1].setIndex(getEnd() - 1);
	}

	void remove(int index)
	{
		m_elements[index].makeGap();
		--m_count;
		while (getEnd() > 0 && m_elements[getEnd() - 1].isGap())
			m_elements.pop_back();
		while (m_begin < getEnd() && m_elements[m_begin].isGap())
			++m_begin;
		m_begin = btMin(m_begin, getEnd());
	}

	/// Forgets all elements without telling them.
	void clear()
	{
		m_elements.resize(0);
		m_begin = m_count = 0;
	}

	void closeGaps()
	{
		if (m_count == getEnd())
			return;
		int kept = 0;
		for (int i = m_begin; i < getEnd(); ++i)
			if (!m_elements[i].isGap())
			{
				if (kept < i)
				{
					m_elements[kept] = m_elements[i];
					m_elements[kept].setIndex(kept);
				}
				++kept;
			}
		m_elements.resize(kept);
		m_begin = 0;
	}

private:
	btAlignedObjectArray<T> m_elements;
	int m_begin = 0;  ///< of the first element
	int m_count = 0;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_GAP_LIST_H

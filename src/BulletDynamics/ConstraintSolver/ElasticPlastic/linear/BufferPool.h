// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BUFFER_POOL_H
#define BT_ELASTIC_PLASTIC_BUFFER_POOL_H

#include <stddef.h>

#include <algorithm>
#include <vector>

namespace btElasticPlastic
{
/// Memory that goes from one plan to the next. As bodies touch and part, plans of a structure follow each other with nearly the same
/// size, and memory that the system gives anew costs more than what is computed in it.
class BufferPool
{
public:
	/// Makes a buffer whose pages the system has provided already: it is filled with zeros.
	void reserve(size_t size) { m_free.emplace_back(size); }

	/// \param buffer  gets at least so many numbers, which mean nothing
	void take(size_t size, std::vector<double>& buffer)
	{
		size_t best = m_free.size();
		for (size_t i = 0; i < m_free.size(); ++i)
			if (fits(i, size) && (best == m_free.size() || m_free[i].capacity() < m_free[best].capacity()))
				best = i;
		buffer.clear();
		if (best < m_free.size())
		{
			buffer.swap(m_free[best]);
			m_free.erase(m_free.begin() + std::ptrdiff_t(best));
		}
		// With room to grow a little, untouched until it is needed.
		if (buffer.capacity() < size)
			buffer.reserve(size + size / 4);
		if (buffer.size() < size)
			buffer.resize(size);
	}

	/// Takes a buffer back.
	void give(std::vector<double>& buffer)
	{
		if (buffer.capacity() == 0)
			return;
		m_free.emplace_back();
		m_free.back().swap(buffer);
		if (m_free.size() <= MOST_FREE)
			return;
		m_free.erase(std::min_element(m_free.begin(), m_free.end(),
									  [](const std::vector<double>& a, const std::vector<double>& b)
									  { return a.capacity() < b.capacity(); }));
	}

private:
	static const size_t MOST_FREE = 8;

	/// What is much larger is left for what needs it.
	bool fits(size_t i, size_t size) const
	{
		return m_free[i].capacity() >= size && m_free[i].capacity() <= 4 * size + 4096;
	}

	std::vector<std::vector<double>> m_free;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BUFFER_POOL_H

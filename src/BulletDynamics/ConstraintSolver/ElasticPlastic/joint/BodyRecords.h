// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_BODY_RECORDS_H
#define BT_ELASTIC_PLASTIC_BODY_RECORDS_H

#include <stddef.h>

#include <vector>

#include "LinearMath/btHashMap.h"

class btRigidBody;

namespace btElasticPlastic
{
/// What is remembered of some of a world's bodies from one substep to the next.
/// \param Record  has the body as m_body, which may have been deleted since
template <class Record>
class BodyRecords
{
public:
	/// For the substep under way.
	void take(const std::vector<Record>& records) { m_taken.insert(m_taken.end(), records.begin(), records.end()); }
	const std::vector<Record>& getTaken() const { return m_taken; }

	/// Forgets what was taken for a substep that does not end.
	void forget() { m_taken.clear(); }

	/// Ends the substep: what was taken in it is that of the last one.
	void end()
	{
		if (m_taken.empty() && m_last.empty())
			return;
		m_last.swap(m_taken);
		m_taken.clear();
		index();
	}

	/// Of the last substep.
	const std::vector<Record>& getLast() const { return m_last; }
	void set(const std::vector<Record>& records)
	{
		m_last = records;
		index();
	}

	/// \return null if there is none of a body
	const Record* find(const btRigidBody& body) const
	{
		const int* const index = m_last.empty() ? nullptr : m_indexOf.find(btHashPtr(&body));
		return index ? &m_last[size_t(*index)] : nullptr;
	}

private:
	void index()
	{
		m_indexOf.clear();
		for (size_t i = 0; i < m_last.size(); ++i)
			m_indexOf.insert(btHashPtr(m_last[i].m_body), int(i));
	}

	std::vector<Record> m_taken, m_last;
	btHashMap<btHashPtr, int> m_indexOf;  ///< of m_last, by body
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_BODY_RECORDS_H

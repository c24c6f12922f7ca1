// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_EVENT_QUEUE_H
#define BT_ELASTIC_PLASTIC_EVENT_QUEUE_H

#include "../../btElasticPlasticEvent.h"
#include "GapList.h"

namespace btElasticPlastic
{
/// Where a joint's unread events are in the queue, by kind: yield, break, and the quantities whose level was passed; -1: there is none.
struct UnreadEvents
{
	int m_index[2 + BT_EP_QUANTITY_COUNT] = {-1, -1, -1, -1, -1, -1};

	int& of(const btElasticPlasticEvent& event)
	{
		return m_index[event.m_type == BT_EP_EVENT_LEVEL ? 2 + int(event.m_quantity) : int(event.m_type)];
	}
};

/// Events that nobody has read yet, in the order in which they happened. It holds the newest of each joint and kind: a joint
/// that is repaired and breaks again and again takes no more room.
class EventQueue
{
public:
	void push(const btElasticPlasticEvent& event, UnreadEvents& ofJoint)
	{
		int& index = ofJoint.of(event);
		remove(index);
		m_events.append({event, &index});
	}

	/// \return false if there is none
	bool pop(btElasticPlasticEvent& event)
	{
		if (m_events.getCount() == 0)
			return false;
		Item& first = m_events.get(0);
		event = first.m_event;
		remove(*first.m_index);
		return true;
	}

	/// Forgets all events of a joint.
	void forget(UnreadEvents& ofJoint)
	{
		for (int& index : ofJoint.m_index)
			remove(index);
	}

	int getCount() const { return m_events.getCount(); }

	/// The n-th unread event, the oldest first.
	const btElasticPlasticEvent& get(int n) { return m_events.get(n).m_event; }

private:
	struct Item
	{
		BT_DECLARE_ALIGNED_ALLOCATOR();

		btElasticPlasticEvent m_event;
		int* m_index;  ///< the joint's, null in a gap

		void setIndex(int index) { *m_index = index; }
		bool isGap() const { return !m_index; }
		void makeGap() { m_index = nullptr; }
	};

	void remove(int& index)
	{
		if (index < 0)
			return;
		m_events.remove(index);
		index = -1;
	}

	GapList<Item> m_events;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_EVENT_QUEUE_H

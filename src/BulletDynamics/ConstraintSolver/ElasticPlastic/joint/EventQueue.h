// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_EVENT_QUEUE_H
#define BT_ELASTIC_PLASTIC_EVENT_QUEUE_H

#include "../../btElasticPlasticEvent.h"
#include "GapList.h"

namespace btElasticPlastic
{
/// Where a joint's unread events are in the queue, by kind: yield, break, the quantities whose level was passed, and of each fibre crack and
/// rupture; -1: there is none.
class UnreadEvents
{
public:
	/// The kind of an event, a small number.
	static int kindOf(const btElasticPlasticEvent& event)
	{
		switch (event.m_type)
		{
			case BT_EP_EVENT_LEVEL:
				return 2 + int(event.m_quantity);
			case BT_EP_EVENT_CRACK:
			case BT_EP_EVENT_RUPTURE:
				return NUM_OF_JOINT + 2 * event.m_fibre + (event.m_type == BT_EP_EVENT_RUPTURE);
			default:
				return int(event.m_type);
		}
	}

	int getNumKinds() const { return NUM_OF_JOINT + m_ofFibres.size(); }

	int& operator[](int kind)
	{
		if (kind < NUM_OF_JOINT)
			return m_ofJoint[kind];
		if (kind - NUM_OF_JOINT >= m_ofFibres.size())
			m_ofFibres.resize(kind - NUM_OF_JOINT + 1, -1);
		return m_ofFibres[kind - NUM_OF_JOINT];
	}

private:
	static constexpr int NUM_OF_JOINT = 2 + BT_EP_QUANTITY_COUNT;

	int m_ofJoint[NUM_OF_JOINT] = {-1, -1, -1, -1, -1, -1};
	btAlignedObjectArray<int> m_ofFibres;
};

/// Events that nobody has read yet, in the order in which they happened. It holds the newest of each joint, kind and fibre: a joint
/// that is repaired and breaks again and again takes no more room.
class EventQueue
{
public:
	void push(const btElasticPlasticEvent& event, UnreadEvents& ofJoint)
	{
		const int kind = UnreadEvents::kindOf(event);
		remove(ofJoint[kind]);
		m_events.append({event, &ofJoint, kind});
	}

	/// \return false if there is none
	bool pop(btElasticPlasticEvent& event)
	{
		if (m_events.getCount() == 0)
			return false;
		Item& first = m_events.get(0);
		event = first.m_event;
		remove((*first.m_ofJoint)[first.m_kind]);
		return true;
	}

	/// Forgets all events of a joint.
	void forget(UnreadEvents& ofJoint)
	{
		for (int kind = 0; kind < ofJoint.getNumKinds(); ++kind)
			remove(ofJoint[kind]);
	}

	int getCount() const { return m_events.getCount(); }

	/// The n-th unread event, the oldest first.
	const btElasticPlasticEvent& get(int n) { return m_events.get(n).m_event; }

private:
	struct Item
	{
		BT_DECLARE_ALIGNED_ALLOCATOR();

		btElasticPlasticEvent m_event;
		UnreadEvents* m_ofJoint;  ///< null in a gap
		int m_kind;

		void setIndex(int index) { (*m_ofJoint)[m_kind] = index; }
		bool isGap() const { return !m_ofJoint; }
		void makeGap() { m_ofJoint = nullptr; }
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

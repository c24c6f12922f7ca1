// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The registry's lists, of joints and of events: order, and the number of elements that are moved.

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "BulletDynamics/ConstraintSolver/ElasticPlastic/joint/EventQueue.h"

namespace testGapList
{
using btElasticPlastic::EventQueue;
using btElasticPlastic::GapList;
using btElasticPlastic::UnreadEvents;

struct Owner
{
	int m_name = 0, m_index = -1;
};

/// Counts how often elements are copied or told where they are: that is what the list does beside constant work.
struct Element
{
	Owner* m_owner;
	static long long s_operations;

	explicit Element(Owner* owner = nullptr) : m_owner(owner) {}
	Element(const Element& other) : m_owner(other.m_owner) { ++s_operations; }
	Element& operator=(const Element& other)
	{
		m_owner = other.m_owner;
		++s_operations;
		return *this;
	}
	void setIndex(int index)
	{
		m_owner->m_index = index;
		++s_operations;
	}
	bool isGap() const { return !m_owner; }
	void makeGap() { m_owner = nullptr; }
};
long long Element::s_operations = 0;

typedef GapList<Element> List;

/// Elements in the list's order, each of which has to know its index.
std::vector<int> namesIn(List& list)
{
	std::vector<int> names;
	for (int i = 0; i < list.getEnd(); ++i)
		if (!list[i].isGap())
		{
			EXPECT_EQ(i, list[i].m_owner->m_index);
			names.push_back(list[i].m_owner->m_name);
		}
	return names;
}

TEST(GapList, KeepsTheOrderOfArrival)
{
	std::mt19937 random(1);
	List list;
	std::vector<Owner> owners(2000);
	std::vector<Owner*> expected, outside;
	for (Owner& owner : owners)
	{
		owner.m_name = int(&owner - owners.data());
		outside.push_back(&owner);
	}
	for (int i = 0; i < 20000; ++i)
	{
		// Grows and shrinks in turn.
		const bool appends = expected.empty() || (!outside.empty() && random() % 5 < (i / 2000 % 2 ? 1 : 4));
		if (appends)
		{
			list.append(Element(outside.back()));
			expected.push_back(outside.back());
			outside.pop_back();
		}
		else
		{
			const size_t which = random() % expected.size();
			list.remove(expected[which]->m_index);
			outside.push_back(expected[which]);
			expected.erase(expected.begin() + long(which));
		}
		ASSERT_EQ(int(expected.size()), list.getCount());
		ASSERT_LE(list.getEnd(), 2 * list.getCount() + 2000);
		if (i % 50 == 0)
		{
			std::vector<int> names;
			for (const Owner* owner : expected)
				names.push_back(owner->m_name);
			ASSERT_EQ(names, namesIn(list));
			for (size_t n = 0; n < expected.size(); n += 97)
				ASSERT_EQ(expected[n], list.get(int(n)).m_owner);
		}
	}
}

/// \return operations per element
double operationsOf(int elements, void (*use)(List&, std::vector<Owner>&))
{
	std::vector<Owner> owners(static_cast<size_t>(elements));
	List list;
	Element::s_operations = 0;
	use(list, owners);
	return double(Element::s_operations) / elements;
}

TEST(GapList, RemovalTakesConstantTime)
{
	void (*const uses[])(List&, std::vector<Owner>&) = {
		// All come, then all go: as they came, backwards, the odd ones first; and by their number.
		[](List& list, std::vector<Owner>& owners)
		{
			for (Owner& owner : owners)
				list.append(Element(&owner));
			for (Owner& owner : owners)
				list.remove(owner.m_index);
		},
		[](List& list, std::vector<Owner>& owners)
		{
			for (Owner& owner : owners)
				list.append(Element(&owner));
			for (size_t i = owners.size(); i-- > 0;)
				list.remove(owners[i].m_index);
		},
		[](List& list, std::vector<Owner>& owners)
		{
			for (Owner& owner : owners)
				list.append(Element(&owner));
			for (size_t start : {1, 0})
				for (size_t i = start; i < owners.size(); i += 2)
					list.remove(owners[i].m_index);
		},
		[](List& list, std::vector<Owner>& owners)
		{
			for (Owner& owner : owners)
				list.append(Element(&owner));
			while (list.getCount() > 0)
				list.remove(list.get(0).m_owner->m_index);
		},
		[](List& list, std::vector<Owner>& owners)
		{
			for (Owner& owner : owners)
				list.append(Element(&owner));
			while (list.getCount() > 0)
				list.remove(list.get(list.getCount() - 1).m_owner->m_index);
		},
		// One stays; others come and go.
		[](List& list, std::vector<Owner>& owners)
		{
			list.append(Element(&owners[0]));
			for (size_t i = 1; i < owners.size(); ++i)
			{
				list.append(Element(&owners[i]));
				list.remove(owners[i].m_index);
			}
			EXPECT_LE(list.getEnd(), 3);
		},
		// A hundred wait, each time the oldest goes.
		[](List& list, std::vector<Owner>& owners)
		{
			for (size_t i = 0; i < owners.size(); ++i)
			{
				list.append(Element(&owners[i]));
				if (i >= 100)
					list.remove(owners[i - 100].m_index);
			}
			EXPECT_LE(list.getEnd(), 300);
		},
	};
	for (const auto& use : uses)
	{
		// Appending copies an element and tells its index; an array that doubles copies it up to twice more; closing gaps when
		// they are more than the elements moves and tells less than one for each that was removed.
		EXPECT_LT(operationsOf(1000, use), 7);
		EXPECT_LT(operationsOf(100000, use), 7);
	}
}

btElasticPlasticEvent eventOf(btElasticPlasticEventType type, double time)
{
	btElasticPlasticEvent event;
	event.m_type = type;
	event.m_time = time;
	event.m_joint = nullptr;
	return event;
}

TEST(EventQueue, HoldsTheNewestOfEachJointAndType)
{
	EventQueue queue;
	UnreadEvents a, b;
	queue.push(eventOf(BT_EP_EVENT_YIELD, 1), a);
	queue.push(eventOf(BT_EP_EVENT_YIELD, 2), b);
	queue.push(eventOf(BT_EP_EVENT_BREAK, 3), a);
	queue.push(eventOf(BT_EP_EVENT_BREAK, 4), b);
	// a was repaired.
	queue.push(eventOf(BT_EP_EVENT_YIELD, 5), a);
	EXPECT_EQ(4, queue.getCount());
	btElasticPlasticEvent event;
	ASSERT_TRUE(queue.pop(event));
	EXPECT_EQ(2, event.m_time);
	queue.forget(b);
	for (double time : {3, 5})
	{
		ASSERT_TRUE(queue.pop(event));
		EXPECT_EQ(time, event.m_time);
	}
	EXPECT_FALSE(queue.pop(event));
	// What was read can come again.
	queue.push(eventOf(BT_EP_EVENT_YIELD, 6), a);
	ASSERT_TRUE(queue.pop(event));
	EXPECT_EQ(6, event.m_time);
	EXPECT_EQ(0, queue.getCount());
}
}  // namespace testGapList

// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_ARCHIVE_H
#define BT_ELASTIC_PLASTIC_ARCHIVE_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <type_traits>
#include <vector>

#include "LinearMath/btAlignedObjectArray.h"
#include "LinearMath/btTransform.h"

namespace btElasticPlastic
{
// A Writer and a Reader are called with the same values in the same order: one function describes both directions.

/// Puts values one after another into a buffer; what no longer fits is counted only.
class Writer
{
public:
	Writer(unsigned char* buffer, size_t capacity) : m_buffer(buffer), m_capacity(capacity) {}

	size_t getSize() const { return m_size; }

	template <class T>
	std::enable_if_t<std::is_arithmetic<T>::value> operator()(T& value)
	{
		put(&value, sizeof value);
	}
	template <class T, size_t N>
	std::enable_if_t<std::is_arithmetic<T>::value> operator()(T (&values)[N])
	{
		put(values, sizeof values);
	}

	/// Begins a list. \return its length
	template <class List>
	size_t list(List& elements)
	{
		uint32_t count = uint32_t(elements.size());
		(*this)(count);
		return size_t(elements.size());
	}

private:
	void put(const void* bytes, size_t size)
	{
		if (m_size + size <= m_capacity)
			memcpy(m_buffer + m_size, bytes, size);
		m_size += size;
	}

	unsigned char* m_buffer;
	size_t m_capacity, m_size = 0;
};

/// Takes values out of a buffer. Past its end it finds zeros and empty lists.
class Reader
{
public:
	Reader(const unsigned char* buffer, size_t size) : m_buffer(buffer), m_size(size) {}

	/// Whether all that was asked for was there, and nothing else.
	bool isComplete() const { return !m_hasFailed && m_place == m_size; }

	template <class T>
	std::enable_if_t<std::is_arithmetic<T>::value> operator()(T& value)
	{
		take(&value, sizeof value);
	}
	void operator()(bool& value)
	{
		unsigned char byte;
		(*this)(byte);
		m_hasFailed |= byte > 1;
		value = byte == 1;
	}

	template <class T, size_t N>
	std::enable_if_t<std::is_arithmetic<T>::value> operator()(T (&values)[N])
	{
		static_assert(!std::is_same<T, bool>::value, "What is read for a bool may be none.");
		take(values, sizeof values);
	}

	template <class List>
	size_t list(List& elements)
	{
		uint32_t count;
		(*this)(count);
		// In memory an element takes up to MOST_GROWTH times the bytes that there are of it: a spoilt count asks for no more.
		m_hasFailed |= count > MOST_GROWTH * (m_size - m_place) / sizeof(elements[0]);
		elements.resize(m_hasFailed ? 0 : decltype(elements.size())(count));
		return size_t(elements.size());
	}

private:
	static constexpr size_t MOST_GROWTH = 16;

	void take(void* values, size_t size)
	{
		m_hasFailed |= m_size - m_place < size;
		if (m_hasFailed)
		{
			memset(values, 0, size);
			return;
		}
		memcpy(values, m_buffer + m_place, size);
		m_place += size;
	}

	const unsigned char* m_buffer;
	size_t m_size, m_place = 0;
	bool m_hasFailed = false;
};

template <class Archive, class T, size_t N>
void transfer(Archive& archive, T (&values)[N])
{
	archive(values);
}

template <class Archive>
void transfer(Archive& archive, btVector3& v)
{
	btScalar values[3] = {v.x(), v.y(), v.z()};
	transfer(archive, values);
	v.setValue(values[0], values[1], values[2]);
}

template <class Archive>
void transfer(Archive& archive, btQuaternion& q)
{
	btScalar values[4] = {q.x(), q.y(), q.z(), q.w()};
	transfer(archive, values);
	q.setValue(values[0], values[1], values[2], values[3]);
}

template <class Archive>
void transfer(Archive& archive, btTransform& t)
{
	for (int i = 0; i < 3; ++i)
		transfer(archive, t.getBasis()[i]);
	transfer(archive, t.getOrigin());
}

/// Lists of what has a transfer() of its own.
template <class Archive, class T>
void transferList(Archive& archive, std::vector<T>& elements)
{
	archive.list(elements);
	for (T& element : elements)
		transfer(archive, element);
}

template <class Archive, class T>
void transferList(Archive& archive, btAlignedObjectArray<T>& elements)
{
	archive.list(elements);
	for (int i = 0; i < elements.size(); ++i)
		transfer(archive, elements[i]);
}

/// Lists of numbers.
template <class Archive, class T>
void transferNumbers(Archive& archive, std::vector<T>& numbers)
{
	archive.list(numbers);
	for (T& number : numbers)
		archive(number);
}

/// A sum that no change of a few neighbouring bits leaves as it is: four of them side by side, since each waits for its last product.
inline uint64_t checksumOf(const unsigned char* bytes, size_t size)
{
	uint64_t sums[4] = {size, 1, 2, 3}, words[4];
	const auto add = [](uint64_t& sum, uint64_t word)
	{
		sum = (sum ^ word) * 0x9E3779B97F4A7C15ull;
		sum ^= sum >> 32;
	};
	size_t done = 0;
	for (; size - done >= sizeof words; done += sizeof words)
	{
		memcpy(words, bytes + done, sizeof words);
		for (int i = 0; i < 4; ++i)
			add(sums[i], words[i]);
	}
	memset(words, 0, sizeof words);
	if (done < size)
		memcpy(words, bytes + done, size - done);
	for (int i = 0; i < 4; ++i)
		add(sums[i], words[i]);
	for (int i = 1; i < 4; ++i)
		add(sums[0], sums[i]);
	return sums[0];
}
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_ARCHIVE_H

// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_LAYOUT_H
#define EP_TEST_LAYOUT_H

#include <stddef.h>
#include <stdint.h>

#include <type_traits>

namespace btElasticPlastic  // where what describes values looks for other descriptions
{
/// An archive that neither reads nor writes, but sees what stands after what: the kinds and sizes of all values. Lists have one element.
/// Two values of one kind that change places go unseen.
class Layout
{
public:
	/// \param flags  what all values are by which a part is there or not
	explicit Layout(bool flags) : m_flags(flags) {}

	template <class T>
	std::enable_if_t<std::is_arithmetic<T>::value> operator()(T&)
	{
		add(std::is_floating_point<T>::value ? 'f' : std::is_signed<T>::value ? 'i' : 'u');
		add(sizeof(T));
	}
	template <class T, size_t N>
	std::enable_if_t<std::is_arithmetic<T>::value> operator()(T (&values)[N])
	{
		for (T& value : values)
			(*this)(value);
	}
	void operator()(bool& value)
	{
		add('b');
		value = m_flags;
	}
	template <class List>
	size_t list(List& elements)
	{
		add('[');
		elements.resize(1);
		return 1;
	}

	uint64_t hash() const { return m_hash; }

private:
	void add(uint64_t byte) { m_hash = (m_hash ^ byte) * 0x100000001B3u; }  // FNV-1a

	bool m_flags;
	uint64_t m_hash = 0xCBF29CE484222325u;
};

/// The layout of an image with all parts that may be missing, and without them.
template <class Image>
uint64_t layoutOf()
{
	uint64_t hashes[2];
	for (const bool flags : {false, true})
	{
		Layout layout(flags);
		Image image;
		transfer(layout, image);
		hashes[flags] = layout.hash();
	}
	return hashes[0] ^ hashes[1] << 1;
}
}  // namespace btElasticPlastic

#endif  // EP_TEST_LAYOUT_H

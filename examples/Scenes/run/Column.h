// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_COLUMN_H
#define EP_COLUMN_H

#include <algorithm>
#include <memory>
#include <string>

namespace ep
{
/// Numbers that come one after another. What has been read of them stays where it is and as it is for as long as somebody holds
/// it: a longer block is a new one.
class Column
{
public:
	explicit Column(const std::string& title) : m_title(title) {}

	const std::string& title() const { return m_title; }
	size_t size() const { return m_size; }
	double operator[](size_t index) const { return m_values[index]; }
	std::shared_ptr<const double[]> values() const { return m_values; }

	void add(double value)
	{
		if (m_size == m_capacity)
			grow();
		m_values[m_size++] = value;
	}

private:
	void grow()
	{
		m_capacity = std::max<size_t>(64, 2 * m_capacity);
		const std::shared_ptr<double[]> longer(new double[m_capacity]);
		std::copy_n(m_values.get(), m_size, longer.get());
		m_values = longer;
	}

	std::string m_title;
	std::shared_ptr<double[]> m_values;
	size_t m_size = 0, m_capacity = 0;
};
}  // namespace ep

#endif  // EP_COLUMN_H

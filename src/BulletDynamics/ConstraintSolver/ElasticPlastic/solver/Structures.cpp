// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "Structures.h"

namespace btElasticPlastic
{
void Structures::find(const SystemInput& input)
{
	const size_t n = input.m_bodies.size();
	m_parent.resize(n);
	m_mass.resize(n);
	m_size.assign(n, 1);
	m_isHeld.assign(n, 0);
	for (size_t b = 0; b < n; ++b)
	{
		m_parent[b] = int(b);
		m_mass[b] = input.m_bodies[b].m_mass[0];
	}
	for (const SystemInput::Unit& unit : input.m_units)
		join(unit.m_body);
	for (const SystemInput::SingleRow& row : input.m_singleRows)
		if (!row.m_isContact)
			join(row.m_body);
}

int Structures::rootOf(int body)
{
	while (m_parent[size_t(body)] != body)
		body = m_parent[size_t(body)] = m_parent[size_t(m_parent[size_t(body)])];
	return body;
}

void Structures::join(const int bodies[2])
{
	if (bodies[0] < 0 || bodies[1] < 0)
	{
		const int moving = bodies[0] < 0 ? bodies[1] : bodies[0];
		if (moving >= 0)
			m_isHeld[size_t(rootOf(moving))] = 1;
		return;
	}
	const int a = rootOf(bodies[0]), b = rootOf(bodies[1]);
	if (a == b)
		return;
	const int root = a < b ? a : b, other = a < b ? b : a;
	m_parent[size_t(other)] = root;
	m_mass[size_t(root)] += m_mass[size_t(other)];
	m_size[size_t(root)] += m_size[size_t(other)];
	m_isHeld[size_t(root)] |= m_isHeld[size_t(other)];
}
}  // namespace btElasticPlastic

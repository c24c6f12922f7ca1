// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_STRUCTURES_H
#define BT_ELASTIC_PLASTIC_STRUCTURES_H

#include <vector>

#include "SystemInput.h"

namespace btElasticPlastic
{
/// What a SystemInput's units and single rows, contacts apart, hold together: each such set of bodies is a structure.
class Structures
{
public:
	void find(const SystemInput& input);

	/// The structure of a body: a body of the same.
	int of(int body) { return rootOf(body); }

	/// Of the structure of a body: kg.
	double getMass(int body) { return m_mass[size_t(rootOf(body))]; }

	/// Whether nothing holds a body but contacts.
	bool isLoose(int body) { return m_size[size_t(rootOf(body))] == 1 && !isHeld(body); }

	/// Whether a row joins the structure of a body to something that does not move.
	bool isHeld(int body) { return m_isHeld[size_t(rootOf(body))] != 0; }

private:
	int rootOf(int body);
	void join(const int bodies[2]);

	std::vector<int> m_parent;   // of a forest
	std::vector<double> m_mass;  // by root
	std::vector<int> m_size;     // bodies, by root
	std::vector<char> m_isHeld;
};
}  // namespace btElasticPlastic

#endif  // BT_ELASTIC_PLASTIC_STRUCTURES_H

// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_ASSEMBLY_H
#define EP_ASSEMBLY_H

#include "scenefile/SceneBuilder.h"

namespace ep
{
/// What holds the end of a member.
enum class Support
{
	Free,
	Pinned,  ///< turns freely in bending
	Fixed
};
const std::vector<Named<Support>>& supports();

/// A structure that a generator makes of parts and joints, all of one material. Names begin with the structure's own.
class Assembly
{
public:
	/// Reads the keys that all generators have: name and material.
	Assembly(Fields& f, SceneBuilder& builder);

	Fields& fields() { return m_fields; }
	SceneBuilder& builder() { return m_builder; }
	const SceneDescription::Material& material() const { return m_material; }

	/// A box that is full of the material. Round it is a gap, so that neighbours do not touch.
	int box(const std::string& name, const btTransform& pose, const btVector3& size);

	/// A straight part of a member, x along it: a box round the section, with the section's mass.
	int part(const std::string& name, const btTransform& pose, double length, const SceneDescription::Section& section);

	/// A joint of a member, between parts of these lengths; 0: a side that does not deform.
	struct Tie
	{
		std::string name;
		int a, b;
		btTransform frame;
		btElasticPlasticSection section;
		double lengthA, lengthB;
		bool isPinned = false;
		bool isRope = false;  ///< bends and twists freely
	};
	void join(const Tie& tie);

	/// A member between two points that is made of parts. Its ends are joined to bodies, or free with an end that is Free.
	struct Line
	{
		std::string name;
		std::vector<btVector3> nodes;  ///< one more than parts
		btVector3 up = btVector3(0, 1, 0);
		SceneDescription::Section section;
		int bodies[2] = {SceneDescription::WORLD, SceneDescription::WORLD};
		Support ends[2] = {Support::Fixed, Support::Fixed};
		bool isRope = false;  ///< its joints bend and twist freely
	};

	/// \return its parts
	std::vector<int> line(const Line& line);

	/// From here on bodies do not collide with others of lattices.
	void beLattice() { m_isLattice = true; }

private:
	int add(SceneDescription::Body body, const std::string& name, const btTransform& pose);

	Fields& m_fields;
	SceneBuilder& m_builder;
	std::string m_name;
	SceneDescription::Material m_material;
	bool m_isLattice = false;
};

// Each reads its keys and adds what they tell.
void beamStructure(Fields& f, SceneBuilder& builder);
void chainStructure(Fields& f, SceneBuilder& builder);
void frameStructure(Fields& f, SceneBuilder& builder);
void wallStructure(Fields& f, SceneBuilder& builder);
void slabStructure(Fields& f, SceneBuilder& builder);
void mastStructure(Fields& f, SceneBuilder& builder);
void gridStructure(Fields& f, SceneBuilder& builder);
}  // namespace ep

#endif  // EP_ASSEMBLY_H

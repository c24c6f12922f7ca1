// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SCENE_BUILDER_H
#define EP_SCENE_BUILDER_H

#include "scenefile/Fields.h"
#include "scenefile/SceneDescription.h"

namespace ep
{
/// Places in a list by names.
typedef std::map<std::string, int> Names;

/// That of a name, or those of all that are like a pattern, in which * stands for any letters.
std::vector<int> placesOf(const std::string& pattern, const Names& names);

/// A scene's description while it grows: what has a name is found by it.
class SceneBuilder
{
public:
	explicit SceneBuilder(SceneDescription& scene) : m_scene(scene) {}

	SceneDescription& scene() { return m_scene; }

	std::map<std::string, SceneDescription::Material> m_materials;
	std::map<std::string, SceneDescription::Section> m_sections;

	/// What is added from now on is of a structure. Where one makes nothing, it has been complained of, and names that it would have
	/// made are not complained of as well.
	void beginStructure(const std::string& name) { m_structures.push_back(name); }

	/// Adds one under its name, which must be new. \param f  the object that it comes from, for complaints
	int add(Fields& f, const SceneDescription::Body& body);
	int add(Fields& f, const SceneDescription::Joint& joint);

	/// A body by its name, also "world". \return WORLD, with a complaint, if there is none
	int body(Fields& f, const char* key, const std::string& name);

	/// Those whose names are like a pattern, in which * stands for any letters. Complains if there is none.
	std::vector<int> bodies(Fields& f, const char* key, const std::string& pattern);
	std::vector<int> joints(Fields& f, const char* key, const std::string& pattern);

	/// Whether there is room for so many more bodies, each with some joints; complains if not.
	bool hasRoom(Fields& f, double bodies);

private:
	std::vector<int> like(Fields& f, const char* key, const std::string& pattern, const Names& names, const char* what);
	bool isLost(const std::string& pattern) const;
	bool addName(Fields& f, Names& names, const std::string& name, size_t index, const char* what);

	SceneDescription& m_scene;
	Names m_bodies, m_joints;
	std::vector<std::string> m_structures, m_refused;  // names; refused: of bodies and joints
};

std::vector<std::string> namesIn(const Names& names);

/// A material or section of the builder's, by name or by value.
bool materialField(Fields& f, const char* key, SceneBuilder& builder, SceneDescription::Material& material,
				   Need need = Need::Optional);
bool sectionField(Fields& f, const char* key, SceneBuilder& builder, SceneDescription::Section& section,
				  Need need = Need::Optional);

// What each kind of object has.
void materialFields(Fields& f, SceneDescription::Material& material);
void sectionFields(Fields& f, SceneBuilder& builder, SceneDescription::Section& section);
void bodyFields(Fields& f, SceneBuilder& builder);
void vehicleFields(Fields& f, SceneBuilder& builder);
void jointFields(Fields& f, SceneBuilder& builder);
void structureFields(Fields& f, SceneBuilder& builder);
void loadFields(Fields& f, SceneBuilder& builder);
void fireFields(Fields& f, SceneBuilder& builder);
void blastFields(Fields& f, SceneDescription::Blast& blast);
void eventFields(Fields& f, SceneBuilder& builder);
void probeFields(Fields& f, SceneBuilder& builder);

/// Pose of a thing: keys at and turn.
void poseFields(Fields& f, btTransform& pose);

/// From a member's axes, in which its section is drawn, to the section's principal ones; its centroid is on the member's line.
btTransform turnOf(const btElasticPlasticSection& section);

/// With x along and y as near to up as can be.
btTransform frameAlong(const btVector3& origin, const btVector3& along, const btVector3& up);
}  // namespace ep

#endif  // EP_SCENE_BUILDER_H

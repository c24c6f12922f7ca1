// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_SCENE_DESCRIPTION_H
#define EP_SCENE_DESCRIPTION_H

#include <map>
#include <string>
#include <vector>

#include "BulletDynamics/ConstraintSolver/btElasticPlasticCapacity.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticJoint.h"
#include "BulletDynamics/ConstraintSolver/btElasticPlasticSolverSettings.h"
#include "LinearMath/btTransform.h"
#include "vehicle/Autopilot.h"
#include "vehicle/VehicleSettings.h"
#include "world/Method.h"

namespace ep
{
/// What a scene's file says, names resolved and generators carried out: all that a simulation is built from. SI units.
struct SceneDescription
{
	struct WorldSettings
	{
		btVector3 gravity = btVector3(0, btScalar(-9.81), 0);
		double ramp = 0;  ///< time in which gravity grows from 0 [s]
		double step = 1. / 60;
		int substeps = 1;
		double error = 0;  ///< allowed by the step control; 0: substeps as given
		double innerError = btElasticPlasticSolverSettings().m_innerError;
		bool keepsSwings = false;
		Solver solver = Solver::Direct;
		int iterations = 10;
		JointKind joints = kinds::Ep2;
		btElasticPlasticScheme scheme = BT_EP_SCHEME_IMPLICIT;
		btElasticPlasticContacts contacts = BT_EP_CONTACTS_BY_ISLAND;
		int threads = 1;
		bool sleeps = false;
		double damping = 0;  ///< share of its velocity that a body loses in a second
		bool ground = false;
		double groundFriction = 0.6;
	};

	struct Material
	{
		btElasticPlasticMaterial law;
		btVector3 colour = btVector3(btScalar(.32), btScalar(.36), btScalar(.42));
	};

	struct Section
	{
		btElasticPlasticSection section;
		double width = 0, height = 0;  ///< of the rectangle around it, along z and y [m]
	};

	enum class ShapeKind
	{
		Box,
		Sphere,
		Cylinder,
		Capsule,
		Hull,
		Compound,
		Mesh
	};

	/// Sizes by kind: of a box x, y, z; of a sphere the radius; of a cylinder or capsule radius and length along y.
	struct Shape
	{
		struct Part;

		ShapeKind kind = ShapeKind::Box;
		btVector3 size = btVector3(1, 1, 1);
		std::vector<btVector3> points;  ///< of a hull; of a mesh three for each triangle
		std::vector<Part> parts;        ///< of a compound
	};

	enum class Motion
	{
		Dynamic,
		Static,
		Kinematic
	};

	struct Body
	{
		std::string name;
		Shape shape;
		btTransform pose = btTransform::getIdentity();
		Motion motion = Motion::Dynamic;
		double density = 7800;  ///< of the shape [kg/m^3], if there is no mass
		double mass = 0;        ///< [kg]; 0: by the density
		btVector3 velocity = btVector3(0, 0, 0), spin = btVector3(0, 0, 0);
		double friction = 0.6, restitution = 0, rollingFriction = 0;
		bool collides = true;
		bool isOfLattice = false;  ///< does not collide with others of which that is true: they meet in nodes
		double appears = 0;        ///< [s]
		btVector3 colour = btVector3(btScalar(.45), btScalar(.43), btScalar(.40));
		/// Of a kinematic body: time [s] and place, straight between them.
		std::vector<std::pair<double, btVector3>> path;
	};

	/// A body on four wheels, of which other bodies feel what they do to them.
	struct Vehicle
	{
		int body = 0;  ///< a box of the settings' size and mass, x forward
		VehicleSettings settings;
		Route route;  ///< empty: it rolls
	};

	enum class JointType
	{
		World,   ///< the world's kind
		Spring,  ///< elastic-plastic, of Bullet's older class
		Paper,   ///< elastic-plastic by the paper's scheme
		Fixed,   ///< this and what follows: Bullet's own
		Hinge,
		Ball,
		Slider,
		ConeTwist,
		SixDof
	};

	/// What a degree of freedom of one of Bullet's own joints may do: of the second body against the first.
	struct Freedom
	{
		bool isGiven = false;
		double from = -never(), to = never();  ///< [m], [rad]
		double stiffness = 0, damping = 0;     ///< of a spring [N/m], [N s/m], [N m/rad], [N m s/rad]; 0: none
		bool isLimited() const { return from > -never() || to < never(); }
		static constexpr double never() { return 1e30; }
	};

	struct Joint
	{
		std::string name;
		int bodies[2] = {WORLD, WORLD};
		btTransform frame = btTransform::getIdentity();  ///< in the world, x along the member, y along its height
		btElasticPlasticCapacity capacity;
		double height = 0, width = 0;  ///< of its section, to be drawn [m]; 0: unknown
		JointType type = JointType::World;
		double breaksAt = 0;                    ///< force at which one of Bullet's own breaks [N]; 0: never
		Freedom freedoms[BT_EP_DOF_COUNT];      ///< of hinges, sliders, cone-twist and six-dof joints
		double motorSpeed = 0, motorForce = 0;  ///< of a hinge [rad/s], [N m]; of a slider [m/s], [N]
		bool collides = false;                  ///< its bodies with each other
	};

	/// Factor over time.
	struct Course
	{
		std::vector<std::pair<double, double>>
			table;                        ///< straight between its points, even before and after them; empty: 1
		double frequency = 0, phase = 0;  ///< of a sine with which it is multiplied [Hz], [degrees]; 0: none
	};

	struct Load
	{
		std::vector<int> bodies;
		btVector3 force = btVector3(0, 0, 0), moment = btVector3(0, 0, 0), at = btVector3(0, 0, 0);
		bool turnsAlong = false;  ///< all of it in the body's own axes
		Course course;
	};

	/// What heat leaves at a temperature.
	typedef btElasticPlasticHeat (*HeatLaw)(btScalar temperature);

	/// Joints of steel that get hot.
	struct Fire
	{
		std::vector<int> joints;
		HeatLaw law = nullptr;
		std::vector<int> parts;  ///< of the joints' sections, see btElasticPlasticFibre::m_part; none: all
		std::vector<std::pair<double, double>>
			temperature;  ///< time [s] and degrees Celsius, straight between points, even before and after them
	};

	/// A wave of pressure from a point, which falls with the distance and lasts shortly.
	struct Blast
	{
		btVector3 at = btVector3(0, 0, 0);
		double time = 0;
		double pressure = 1e5;  ///< at a distance of 1 m [Pa]
		double decay = 2;       ///< the pressure falls with this power of the distance
		double duration = 0.01;
		double speed = 340;
	};

	struct Event
	{
		double time = 0;
		std::vector<int> removed, cut;  ///< bodies, joints
		std::vector<int> pushed;        ///< bodies
		btVector3 velocity = btVector3(0, 0, 0);
	};

	enum class Measure
	{
		Position,
		Displacement,
		Velocity,
		Spin,
		Turn,
		KineticEnergy,
		Force,  ///< this and what follows down to Broken: of joints
		Deformation,
		PlasticDeformation,
		Utilisation,
		Damage,
		ElasticEnergy,
		PlasticEnergy,
		Broken,
		ContactForce
	};
	static bool isOfJoint(Measure measure) { return measure >= Measure::Force && measure <= Measure::Broken; }

	enum class Gather
	{
		Sum,
		Mean,
		Least,
		Most
	};

	struct Probe
	{
		std::string name;
		Measure measure = Measure::Position;
		std::vector<int> things;  ///< bodies, or joints
		std::vector<int> others;  ///< of a contact: bodies on the other side, empty: all
		int part = 1;             ///< axis, 3: length; degree of freedom of a joint
		Gather gather = Gather::Sum;
	};

	struct End
	{
		double time = 5;
		double standstill = 0;  ///< when no body has been faster for half a second [m/s]; 0: not asked
		bool firstBreak = false;
	};

	/// What the scene is meant to do: a run tells what it does not.
	struct Expectation
	{
		std::string probe;  ///< empty: the number of broken joints
		double least = 0, most = 0;
	};

	struct CameraPose
	{
		bool isGiven = false;
		btVector3 from = btVector3(0, 10, 40), to = btVector3(0, 0, 0);
	};

	static constexpr int WORLD = -1;  ///< in place of a body

	std::string title, about;
	WorldSettings world;
	std::vector<Body> bodies;
	std::vector<Vehicle> vehicles;
	std::vector<Joint> joints;
	std::vector<Load> loads;
	std::vector<Fire> fires;
	std::vector<Blast> blasts;
	std::vector<Event> events;
	std::vector<Probe> probes;
	End end;
	std::vector<Expectation> expectations;
	CameraPose camera;
	double pictureTime = -1;  ///< of the gallery's picture [s]; below 0: the end
};

struct SceneDescription::Shape::Part
{
	Shape shape;
	btTransform pose = btTransform::getIdentity();
};

// In a file's words.
const std::vector<Named<SceneDescription::JointType>>& jointTypes();
const std::vector<Named<SceneDescription::Measure>>& measures();
const std::vector<Named<SceneDescription::Gather>>& gathers();
}  // namespace ep

#endif  // EP_SCENE_DESCRIPTION_H

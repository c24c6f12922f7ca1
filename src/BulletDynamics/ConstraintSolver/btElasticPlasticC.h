/* SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors */
/* SPDX-License-Identifier: Zlib */

/* Elastic-plastic joints for programs in C, and in other languages by way of C: a world of boxes and spheres, joints between them, and
   events. Engines in C++ use the classes, which can do more.

   All numbers are double, whatever Bullet's precision; units are SI or any consistent ones. Vectors have three numbers, rotations are
   quaternions x, y, z, w. Bodies and joints are numbers above 0 that are never used again; worlds are pointers. Arrays are by degree of
   freedom: axial, shear y, shear z, torsion, bending y, bending z.

   Numbers have ranges, in whatever units, beyond which they are refused: single precision does not bear what comes of them. Coordinates
   are within +-1e9, velocities +-1e8, angular velocities +-1e4, gravity +-1e7, forces +-1e18 and +-1e12 times the body's mass, steps from
   1e-9 to 1e3; bodies' ranges are below. In single precision inertias are limited to some 1e12, by the cube that Bullet takes of them.

   Functions return BTEP_OK or what is wrong, and then change nothing; btep_world_message() says it in words. A struct's m_size is to
   be sizeof of it: later versions may have more at its end. Pointers to results may not be null. A world is for one thread at a time. */

#ifndef BT_ELASTIC_PLASTIC_C_H
#define BT_ELASTIC_PLASTIC_C_H

#include <stddef.h>

#ifdef __cplusplus
extern "C"
{
#endif

/* Of this header. A library refuses programs that were compiled with another one. */
#define BTEP_VERSION 4

	typedef struct btep_world btep_world;

	enum btep_result
	{
		BTEP_OK = 0,
		BTEP_NO_EVENT = 1,     /* there is no event to tell of; no error */
		BTEP_BAD_POINTER = -1, /* a pointer is null */
		BTEP_BAD_HANDLE = -2,  /* no body or joint of the world has this number */
		BTEP_BAD_VALUE = -3,   /* a value is out of its range */
		BTEP_BAD_VERSION =
			-4, /* the program was compiled with another version's header, or a struct's m_size is not that of a known version */
		BTEP_NOT_FINITE = -5 /* a body has come to be no number, by values that are extreme together */
	};

	enum btep_shape
	{
		BTEP_BOX = 0,   /* m_extent: lengths of its edges [m], 1e-6 to 1e7 */
		BTEP_SPHERE = 1 /* m_extent[0]: radius [m], 1e-6 to 1e7 */
	};

	enum btep_event_type
	{
		BTEP_YIELD = 0, /* it flowed for the first time */
		BTEP_BREAK = 1, /* its ductility is spent; it holds nothing any more */
		BTEP_LEVEL = 2, /* its utilisation has risen to the level of btep_joint_set_level() */
		BTEP_CRACK =
			3, /* a fibre that is weaker in tension than in compression has torn: it bears again where it closes */
		BTEP_RUPTURE = 4 /* a fibre has torn or was crushed: it bears nothing any more */
	};

	struct btep_body_description
	{
		size_t m_size;
		int m_shape;          /* btep_shape */
		double m_extent[3];   /* see btep_shape */
		double m_mass;        /* [kg], 1e-12 to 1e12; 0: it does not move by itself */
		double m_position[3]; /* of its middle [m] */
		double m_rotation[4]; /* of any length but 0 */
		double m_friction;    /* 0 to 100; Bullet has 0.5 */
	};

	/* Stiffness, yield value and ductility by degree of freedom; see btElasticPlasticCapacity. */
	struct btep_capacity
	{
		size_t m_size;
		double m_stiffness[6]; /* [N/m], [N m/rad] */
		double m_yield[6];     /* [N], [N m]; 0: free */
		double m_ductility[6]; /* plastic deformation at which it breaks [m], [rad], > 0; 1e18 and more: never */
		double m_coupling[2];  /* of shear and bending, as btep_capacity_of_member() finds it; 0 by hand */
		double m_length;       /* of the member [m]; 0 by hand */
		double m_damping;      /* damping ratio of the material, 0 (none) to 0.1 */
		int m_fibres; /* number of the fibres of btep_capacity_of_section(); 0: forces and moments yield each by itself */
		double m_friction; /* what pressure adds to the yield value of each shear, over it, 0 (nothing) to 2 */
	};

	struct btep_material
	{
		size_t m_size;
		double m_youngs_modulus;          /* [Pa], > 0 */
		double m_poissons_ratio;          /* > -1 and <= 0.5 */
		double m_yield_stress;            /* [Pa], > 0 */
		double m_ultimate_plastic_strain; /* > 0 */
		double m_damping_ratio;           /* of critical, 0 (none) to 0.1; steel has 0.01, concrete 0.03 */
		/* Of fibres: */
		double
			m_tensile_share; /* strength in tension over that in compression, >= 0; 1 of steel, 0: opens without a force */
		double m_crushing_strain; /* > 0; 0: as the ultimate plastic strain */
		/* Of all: */
		double m_shear_modulus;  /* [Pa]; 0: by the modulus and the ratio */
		double m_shear_strength; /* [Pa]; 0: half of the yield stress */
		double m_friction;       /* what pressure adds to that, over it, 0 to 2 */
	};

	struct btep_joint_state
	{
		size_t m_size;
		double m_force[6];       /* that was applied in the last step [N], [N m]; positive axial force is tension */
		double m_plastic[6];     /* plastic deformation [m], [rad] */
		double m_utilisation;    /* 1 is yield */
		double m_damage;         /* 1 breaks */
		double m_elastic_energy; /* [J] */
		double m_plastic_energy; /* [J] */
		double m_damping_energy; /* [J] */
		int m_is_broken;
	};

	struct btep_event
	{
		size_t m_size;
		int m_type; /* btep_event_type */
		int m_joint;
		int m_dof;            /* that decided, 0 to 5 */
		double m_time;        /* of the world [s] */
		double m_energy;      /* taken up by the joint so far [J] */
		double m_position[3]; /* [m] */
		double m_impulse[3];  /* on body A in the step, along the world's axes [N s] */
		double m_velocity[3]; /* of body B against body A, along the world's axes [m/s] */
		int m_fibre;          /* that has cracked or ruptured; -1 of other events */
		int m_part; /* of the section it belongs to: 0 the section itself, i its i-th bar; -1 of other events */
	};

	struct btep_fibre
	{
		size_t m_size;
		double m_force;       /* [N]; tension is positive */
		double m_elongation;  /* elastic and plastic [m] */
		double m_plastic;     /* what of it would stay without a force [m] */
		double m_utilisation; /* 1 is yield */
		double m_damage;      /* 1: it bears nothing */
		int m_is_cracked;     /* it bears pressure only */
		int m_part;           /* as of an event */
	};

	/* The version of the library. */
	int btep_version(void);

	/* version: BTEP_VERSION. gravity [m/s^2]. */
	int btep_world_create(int version, const double gravity[3], btep_world** world);

	/* Of null it does nothing. Its bodies and joints go with it. */
	void btep_world_destroy(btep_world* world);

	/* One step of a length [s].
   \return BTEP_NOT_FINITE if a body is not finite after it, and as long as there is one */
	int btep_world_step(btep_world* world, double length);

	/* What the last call that failed had to say, in English; never null. It is valid until the next call. */
	const char* btep_world_message(const btep_world* world);

	int btep_body_create(btep_world* world, const struct btep_body_description* description, int* body);

	/* Takes its joints with it. */
	int btep_body_destroy(btep_world* world, int body);

	int btep_body_get_pose(btep_world* world, int body, double position[3], double rotation[4]);
	int btep_body_get_velocity(btep_world* world, int body, double linear[3], double angular[3]);
	int btep_body_set_velocity(btep_world* world, int body, const double linear[3], const double angular[3]);

	/* A force through the body's middle for the next step [N]. */
	int btep_body_apply_force(btep_world* world, int body, const double force[3]);

	/* Of the joint between two parts of a member with a rectangular section, width along z and height along y [m]; the lengths of its parts
   are along x [m], 0 for a support. See btElasticPlasticCapacity::fromMember(). */
	int btep_capacity_of_member(btep_world* world, const struct btep_material* material, double width, double height,
								double length_a, double length_b, struct btep_capacity* capacity);

	/* A rectangle that is cut into about so many fibres, 0: as many as are right within 3 %. Axial force and bending moments of joints with it yield
   together, as in the section itself. See btElasticPlasticSection::withFibres(). */
	int btep_section_create(btep_world* world, const struct btep_material* material, double width, double height,
							int num_fibres, int* section);

	/* Adds a bar of a material of its own, one more fibre, at (y, z) [m]. The first is part 1 of the section. */
	int btep_section_add_bar(btep_world* world, int section, double y, double z, double area,
							 const struct btep_material* material);

	/* As btep_capacity_of_member(). gauge_length: over which plastic strain spreads when it tears [m]; 0: the length between the parts' middles. The
   section may change or go afterwards, and the capacity serves any number of joints of this world. */
	int btep_capacity_of_section(btep_world* world, int section, double length_a, double length_b, double gauge_length,
								 struct btep_capacity* capacity);

	/* Its number is never used again. */
	int btep_section_destroy(btep_world* world, int section);

	/* At a place of the world, with the x axis of the rotation along the member, from A to B. The two do not collide with each other until
   the joint breaks. */
	int btep_joint_create(btep_world* world, int body_a, int body_b, const double position[3], const double rotation[4],
						  const struct btep_capacity* capacity, int* joint);
	int btep_joint_destroy(btep_world* world, int joint);
	int btep_joint_get_state(btep_world* world, int joint, struct btep_joint_state* state);

	int btep_joint_get_num_fibres(btep_world* world, int joint, int* count);

	/* fibre: 0 to their number less 1 */
	int btep_joint_get_fibre(btep_world* world, int joint, int fibre, struct btep_fibre* reading);

	/* Has BTEP_LEVEL come when the joint's utilisation rises to a level > 0. */
	int btep_joint_set_level(btep_world* world, int joint, double utilisation);

	/* The oldest event that has not been read. Of each joint, type and fibre the newest is kept: unread, they stay bounded.
   \return BTEP_NO_EVENT if there is none */
	int btep_event_next(btep_world* world, struct btep_event* event);

#ifdef __cplusplus
}
#endif

#endif /* BT_ELASTIC_PLASTIC_C_H */

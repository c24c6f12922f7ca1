# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

# Finds Bullet, for our build as for a project that uses our installed package.
#
#   ep_find_bullet(<variable> [<precision>])  the precisions that the Bullet at hand comes in: float, double or both;
#                                             <precision> helps where the Bullet itself does not tell
#   ep_import_bullet(<precision>)             makes the target BulletElasticPlastic::Bullet (float)
#                                             or BulletElasticPlastic::Bullet-float64 (double)
#   ep_find_bullet_library(<variable> <precision> <name>)
#                                             one of Bullet's that ours does not need, as BulletSoftBody; empty: there is none
#
# Used, in this order: the targets of a Bullet in the same build; BULLET_ROOT, and then no other; Bullet_DIR,
# CMAKE_PREFIX_PATH, the system. Libraries come from where the headers are, so that two Bullets never mix.

set(_ep_bullet_libraries BulletDynamics BulletCollision LinearMath)
set(_ep_bullet_missing "Bullet Physics was not found. Install it (Debian and Ubuntu: libbullet-dev), or name \
the directory where yours is installed with -DBULLET_ROOT=... or -DCMAKE_PREFIX_PATH=..., or that of its \
BulletConfig.cmake with -DBullet_DIR=..., or add Bullet to your build before this project.")

function(ep_find_bullet result)
	if(TARGET BulletDynamics AND TARGET BulletCollision AND TARGET LinearMath)
		# Bullet sets its precision for whole directories.
		get_target_property(directory LinearMath SOURCE_DIR)
		get_directory_property(definitions DIRECTORY ${directory} COMPILE_DEFINITIONS)
		get_target_property(public_definitions LinearMath INTERFACE_COMPILE_DEFINITIONS)
		set(found TRUE)
		set(found-float64 FALSE)
	else()
		set(root ${BULLET_ROOT} $ENV{BULLET_ROOT})
		if(root)
			set(only NO_DEFAULT_PATH)
		endif()
		# Bullet's own package file makes no targets, and the directories in it may be relative;
		# it tells the precision and the prefix.
		find_package(Bullet CONFIG QUIET HINTS ${root} ${only})
		set(definitions "${BULLET_DEFINITIONS}")
		find_path(BULLET_EP_BULLET_INCLUDE_DIR BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h
			HINTS ${root} ${Bullet_DIR}/../../.. ${BULLET_ROOT_DIR} PATH_SUFFIXES include/bullet bullet ${only}
			DOC "Directory of Bullet's headers")
		string(REGEX REPLACE "/include(/bullet)?$" "" prefix "${BULLET_EP_BULLET_INCLUDE_DIR}")
		foreach(suffix IN ITEMS "" -float64)
			set(found${suffix} ${BULLET_EP_BULLET_INCLUDE_DIR})
			foreach(library IN LISTS _ep_bullet_libraries)
				find_library(BULLET_EP_${library}${suffix}_LIBRARY ${library}${suffix}
					HINTS ${prefix} PATH_SUFFIXES lib/${CMAKE_LIBRARY_ARCHITECTURE} lib lib64 NO_DEFAULT_PATH)
				mark_as_advanced(BULLET_EP_${library}${suffix}_LIBRARY)
				if(NOT BULLET_EP_${library}${suffix}_LIBRARY)
					set(found${suffix} FALSE)
				endif()
			endforeach()
		endforeach()
	endif()

	set(precisions "")
	if(found)
		if("${definitions};${public_definitions}" MATCHES BT_USE_DOUBLE_PRECISION
			OR ("${ARGN}" STREQUAL double AND NOT found-float64))
			set(precisions double)
		else()
			set(precisions float)
		endif()
	endif()
	if(found-float64)
		list(APPEND precisions double)
		list(REMOVE_DUPLICATES precisions)
	endif()
	set(${result} "${precisions}" PARENT_SCOPE)
endfunction()

function(ep_import_bullet precision)
	set(suffix "")
	if(precision STREQUAL double)
		set(suffix -float64)
	endif()
	set(target BulletElasticPlastic::Bullet${suffix})
	if(TARGET ${target})
		return()
	endif()
	add_library(${target} INTERFACE IMPORTED GLOBAL)
	if(precision STREQUAL double)
		target_compile_definitions(${target} INTERFACE BT_USE_DOUBLE_PRECISION)
	endif()

	if(TARGET LinearMath)
		get_target_property(directory LinearMath SOURCE_DIR)
		target_include_directories(${target} INTERFACE ${directory}/..)
		target_link_libraries(${target} INTERFACE ${_ep_bullet_libraries})
	else()
		target_include_directories(${target} INTERFACE ${BULLET_EP_BULLET_INCLUDE_DIR})
		foreach(library IN LISTS _ep_bullet_libraries)
			# A Bullet built for double precision alone has no suffix.
			if(BULLET_EP_${library}${suffix}_LIBRARY)
				set(file ${BULLET_EP_${library}${suffix}_LIBRARY})
			else()
				set(file ${BULLET_EP_${library}_LIBRARY})
			endif()
			target_link_libraries(${target} INTERFACE ${file})
		endforeach()
	endif()
endfunction()

function(ep_find_bullet_library result precision name)
	set(${result} "" PARENT_SCOPE)
	set(suffix "")
	if(precision STREQUAL double AND BULLET_EP_LinearMath-float64_LIBRARY)
		set(suffix -float64)
	endif()
	if(TARGET ${name})
		set(${result} ${name} PARENT_SCOPE)
	elseif(BULLET_EP_LinearMath${suffix}_LIBRARY)
		get_filename_component(directory "${BULLET_EP_LinearMath${suffix}_LIBRARY}" DIRECTORY)
		find_library(BULLET_EP_${name}${suffix}_LIBRARY ${name}${suffix} HINTS ${directory} NO_DEFAULT_PATH)
		mark_as_advanced(BULLET_EP_${name}${suffix}_LIBRARY)
		if(BULLET_EP_${name}${suffix}_LIBRARY)
			set(${result} ${BULLET_EP_${name}${suffix}_LIBRARY} PARENT_SCOPE)
		endif()
	endif()
endfunction()

# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

# ep_write_pkg_config(<precision>) writes bullet-elastic-plastic.pc or bullet-elastic-plastic-float64.pc into the build folder. Bullet is
# named by its own .pc file where that lies beside its libraries, as in Debian, and else by its folders.
function(ep_write_pkg_config precision)
	set(pc_precision ${precision})
	set(pc_suffix ${EP_SUFFIX_${precision}})
	set(pc_requires "")
	set(pc_bullet_cflags "")
	set(pc_bullet_libs "")
	# Where it is installed may be told only then: from the file's own place.
	file(RELATIVE_PATH up "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
	string(REGEX REPLACE "/$" "" up "${up}")
	set(pc_prefix "\${pcfiledir}/${up}")

	set(bullet BulletElasticPlastic::Bullet${pc_suffix})
	get_target_property(libraries ${bullet} INTERFACE_LINK_LIBRARIES)
	list(GET libraries 0 library)
	get_filename_component(directory "${library}" DIRECTORY)
	if(EXISTS "${directory}/pkgconfig/bullet${pc_suffix}.pc")
		set(pc_requires bullet${pc_suffix})
	else()
		set(includes "${BULLET_EP_BULLET_INCLUDE_DIR}")
		set(pc_bullet_cflags "-I${includes}")
		if(precision STREQUAL double)
			string(APPEND pc_bullet_cflags " -DBT_USE_DOUBLE_PRECISION")
		endif()
		list(JOIN libraries " " pc_bullet_libs)
	endif()
	# A static library does not name what C++ itself needs, and linkers for other languages do not add it: a program in C is linked by gcc.
	set(pc_language_libs "")
	if(NOT BUILD_SHARED_LIBS)
		set(language ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
		list(REMOVE_DUPLICATES language)
		list(FILTER language EXCLUDE REGEX "^(gcc.*|c)$")
		list(TRANSFORM language PREPEND -l)
		list(JOIN language " " pc_language_libs)
	endif()
	configure_file(${PROJECT_SOURCE_DIR}/cmake/bullet-elastic-plastic.pc.in bullet-elastic-plastic${pc_suffix}.pc @ONLY)
endfunction()

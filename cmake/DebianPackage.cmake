# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

# cpack -G DEB makes libbullet-elastic-plastic-dev of what is installed. The maintainer is told by DEBFULLNAME and DEBEMAIL, as Debian's own
# tools ask for it.
#
# This file is read twice: when the build is configured, and by CPack before it packs, when it gives Debian's places and forms to
# documentation, and takes debugging information out of libraries.
cmake_policy(SET CMP0007 NEW)  # CPack sets none, and empty lines count
if(NOT CPACK_TEMPORARY_DIRECTORY)
	set(CPACK_PACKAGE_NAME libbullet-elastic-plastic-dev)
	set(CPACK_PACKAGE_VENDOR "Bullet Elastic-Plastic contributors")
	set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
	set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "joints for Bullet Physics that bend before they break")
	set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Elastic-plastic constraints between rigid bodies, and a direct solver for
them: they spring, yield at a force or moment, stay bent, take up energy, and
tear when their ductility is spent. For games, effects and engineering models.
This package has the static libraries and the headers.")
	set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
	set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
	set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
	set(CPACK_DEBIAN_PACKAGE_DEPENDS "libbullet-dev (>= 3.24)")
	set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
	set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
	set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_FILE})
	set(CPACK_EP_SOURCE ${PROJECT_SOURCE_DIR})
	set(CPACK_EP_STRIP ${CMAKE_STRIP})
	set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/DebianMaintainer.cmake)
	set(CPACK_VERBATIM_VARIABLES ON)
	include(CPack)
	return()
endif()

set(root "${CPACK_TEMPORARY_DIRECTORY}/usr")
set(documentation "${root}/share/doc/${CPACK_PACKAGE_NAME}")
file(MAKE_DIRECTORY "${root}/share/doc")
file(GLOB installed "${root}/share/doc/*")
file(RENAME "${installed}" "${documentation}")
file(REMOVE "${documentation}/LICENSE.txt")

file(STRINGS "${CPACK_EP_SOURCE}/LICENSE.txt" lines)
list(POP_FRONT lines title)
set(licence "")
foreach(line IN LISTS lines)
	if(line STREQUAL "")
		set(line .)
	endif()
	string(APPEND licence " ${line}\n")
endforeach()
file(WRITE "${documentation}/copyright" "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Bullet Elastic-Plastic

Files: *
Copyright: 2026 Bullet Elastic-Plastic contributors
License: Zlib
${licence}")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${documentation}/changelog.Debian" "bullet-elastic-plastic (${CPACK_PACKAGE_VERSION}-1) unstable; urgency=medium

  * What has changed is told in docs/changes.md.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
execute_process(COMMAND gzip -9n "${documentation}/changelog.Debian" COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE libraries "${root}/lib/*.a")
execute_process(COMMAND "${CPACK_EP_STRIP}" --strip-debug --remove-section=.comment --remove-section=.note -D ${libraries}
	COMMAND_ERROR_IS_FATAL ANY)

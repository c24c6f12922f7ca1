# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

# Read by cpack: who makes a package may be another than who configured the build.
if(CPACK_GENERATOR STREQUAL DEB)
	if("$ENV{DEBFULLNAME}" STREQUAL "" OR "$ENV{DEBEMAIL}" STREQUAL "")
		message(FATAL_ERROR "Set DEBFULLNAME and DEBEMAIL to the maintainer's name and address")
	endif()
	set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
	set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${CPACK_PACKAGE_CONTACT}")
endif()

# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

install_library()
set(EP_HEADERS "${prefix}/include/bullet-elastic-plastic")
set(EP_OUTPUT "${work}/reference")
configure_file("${root}/docs/Doxyfile.in" "${work}/Doxyfile" @ONLY)
execute_process(COMMAND doxygen "${work}/Doxyfile" WORKING_DIRECTORY "${work}" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB pages "${work}/reference/html/classbt*.html")
list(LENGTH pages count)
if(count LESS 8)
	message(FATAL_ERROR "The reference has only ${count} classes")
endif()

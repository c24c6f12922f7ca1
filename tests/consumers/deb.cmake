# SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
# SPDX-License-Identifier: Zlib

set(ENV{DEBFULLNAME} "Test")
set(ENV{DEBEMAIL} "test@localhost.localdomain")
execute_process(COMMAND cpack -G DEB -C "${CONFIG}" --config "${binaries}/CPackConfig.cmake" -B "${work}"
	COMMAND_ERROR_IS_FATAL ANY)
file(GLOB package "${work}/*.deb")
# The address is none, nobody asks for a bug to be closed, and a build that is not configured for the prefix /usr has no folder for each
# architecture.
run(lintian --fail-on error,warning --suppress-tags
	initial-upload-closes-no-bugs,bogus-mail-host,bogus-mail-host-in-debian-changelog,pkg-config-unavailable-for-cross-compilation
	"${package}")

# README.md shows the program whole, but for the two lines on its licence.
file(READ ${PROGRAM} program)
file(READ ${README} readme)
string(REGEX REPLACE "^(// SPDX[^\n]*\n)+\n" "" program "${program}")
string(FIND "${readme}" "${program}" place)
if(place EQUAL -1)
	message(FATAL_ERROR "README.md does not show ${PROGRAM} as it is")
endif()

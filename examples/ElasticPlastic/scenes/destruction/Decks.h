// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_DECKS_H
#define EP_DECKS_H

#include "scenes/destruction/Stage.h"

namespace ep
{
/// A bridge of concrete plates on columns, its ends joined to the ground, and vehicles on it whose wheels turn on hinges.
struct Bridge
{
	int length = 40, width = 8;  ///< plates of 1 m
	int vehicles = 10;           ///< in two lanes
	bool drives = true;          ///< else the wheels are braked

	void build(Stage& stage) const;
};

/// A plate on four legs with loose boxes in two layers, and a ball that falls on it when they lie.
struct Plate
{
	int side = 20;  ///< parts of 0.5 m
	int boxes = 500;
	bool isHit = true;

	void build(Stage& stage) const;
};

/// A deck on four legs that bears a pyramid of loose boxes.
struct PyramidOnDeck
{
	int side = 8;    ///< parts of 0.6 m
	int layers = 5;  ///< of the pyramid, 55 boxes
	double boxMass = 40;

	void build(Stage& stage) const;
};
}  // namespace ep

#endif  // EP_DECKS_H

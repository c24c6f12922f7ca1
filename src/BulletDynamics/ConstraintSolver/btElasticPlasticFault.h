// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef BT_ELASTIC_PLASTIC_FAULT_H
#define BT_ELASTIC_PLASTIC_FAULT_H

#include <string.h>

#include "LinearMath/btScalar.h"
#include "btElasticPlasticDof.h"

/// What is wrong with an input: which quantity, its value, and what it may be.
/// It is copied along with the data (section, capacity, joint), so that the function that refuses can name the value that is
/// wrong.
struct btElasticPlasticFault
{
	const char* m_quantity = nullptr;  ///< name and unit, a string literal; null: nothing is wrong
	const char* m_range = nullptr;     ///< what is valid, a string literal
	btScalar m_value = 0;              ///< the value that was given
	int m_dof = -1;                    ///< degree of freedom it belongs to (0 to 5), -1: none

	btElasticPlasticFault() {}
	btElasticPlasticFault(const char* quantity, btScalar value, const char* range, int dof = -1)
		: m_quantity(quantity), m_range(range), m_value(value), m_dof(dof)
	{
	}

	explicit operator bool() const { return m_quantity != nullptr; }

	/// Writes "quantity of degree of freedom d (name) is value; it must be range" to text, always terminated.
	void print(char* text, int capacity) const;
};

// Games compile with -ffast-math, which lets the compiler drop isfinite() and x == x, and turn !(x > 0) into x <= 0: the bits tell
// instead. Clang from version 18 on knows that, too, and takes what has been computed for finite; what is read from memory may
// be anything.

/// The bits of a number without its sign.
inline unsigned long long btElasticPlasticMagnitudeBits(double value)
{
	const volatile double inMemory = value;
	const double read = inMemory;
	unsigned long long bits;
	memcpy(&bits, &read, sizeof bits);
	return bits & 0x7fffffffffffffffull;
}

/// True for numbers that are neither NaN nor infinite, whatever the compiler assumes of mathematics.
inline bool btElasticPlasticIsFinite(double value)
{
	return btElasticPlasticMagnitudeBits(value) < 0x7ff0000000000000ull;
}

/// True for all but NaN, whatever the compiler assumes of mathematics.
inline bool btElasticPlasticIsNumber(double value)
{
	return btElasticPlasticMagnitudeBits(value) <= 0x7ff0000000000000ull;
}

/// Fault for a value that is not a finite number greater than zero.
btElasticPlasticFault btElasticPlasticCheckPositive(const char* quantity, btScalar value, int dof = -1);

/// Fault for a value that is not a finite number of at least zero.
btElasticPlasticFault btElasticPlasticCheckNotNegative(const char* quantity, btScalar value, int dof = -1);

/// Fault for a damping ratio that is not from 0 to 0.1.
btElasticPlasticFault btElasticPlasticCheckDampingRatio(btScalar value);
/// From 0 to 2.
btElasticPlasticFault btElasticPlasticCheckFriction(btScalar value);

#endif  // BT_ELASTIC_PLASTIC_FAULT_H

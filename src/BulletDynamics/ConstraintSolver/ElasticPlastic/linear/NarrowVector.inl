// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The vectors of two doubles that every machine has, for BlockKernel.inl; included by BlockKernel.cpp with and without fused products.

typedef double Vector __attribute__((vector_size(16)));
const int Width = 2;
BT_KERNEL inline Vector broadcast(double a) { return Vector{a, a}; }
BT_KERNEL inline Vector load(const double* p)
{
	Vector a;
	memcpy(&a, p, sizeof a);
	return a;
}
BT_KERNEL inline void store(double* p, Vector a) { memcpy(p, &a, sizeof a); }
BT_KERNEL inline void storePart(double* p, Vector a, int) { store(p, a); }
const int TileRows = 3, TileColumns = 3;

struct Sum
{
	Vector m_low, m_high;
};
BT_KERNEL inline void clear(Sum& sum) { sum.m_low = sum.m_high = broadcast(0); }
BT_KERNEL inline void addProducts(Sum& sum, const double* a, const double* b)
{
	sum.m_low += load(a) * load(b);
	sum.m_high += load(a + 2) * load(b + 2);
}
BT_KERNEL inline double total(const Sum& sum)
{
	return (sum.m_low[0] + sum.m_low[1]) + (sum.m_high[0] + sum.m_high[1]);
}

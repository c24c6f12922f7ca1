// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// Four sums of products in one vector, for BlockKernel.inl; included by BlockKernel.cpp for the wider instruction sets.

typedef __m256d Sum;
BT_KERNEL inline void clear(Sum& sum) { sum = _mm256_setzero_pd(); }
BT_KERNEL inline void addProducts(Sum& sum, const double* a, const double* b)
{
	sum += _mm256_loadu_pd(a) * _mm256_loadu_pd(b);
}
BT_KERNEL inline double total(const Sum& sum) { return (sum[0] + sum[1]) + (sum[2] + sum[3]); }

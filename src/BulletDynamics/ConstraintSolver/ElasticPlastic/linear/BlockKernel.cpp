// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "BlockKernel.h"

#include <float.h>
#include <math.h>
#include <string.h>

#if defined(__GNUC__) && defined(__x86_64__)
#define BT_KERNEL_X86
#include <immintrin.h>
#endif

// BT_UNROLL(n) is put before loops of n turns over values that are to stay in registers.
#if defined(__clang__)
#define BT_UNROLL(n) _Pragma("clang loop unroll(full)")
#define BT_UNROLL_NOT _Pragma("clang loop unroll(disable)")
// Without optimisation clang warns that it has not unrolled them.
#pragma clang diagnostic ignored "-Wpass-failed"
#elif defined(__GNUC__)
#define BT_UNROLL_TEXT(text) _Pragma(#text)
#define BT_UNROLL(n) BT_UNROLL_TEXT(GCC unroll n)
#define BT_UNROLL_NOT BT_UNROLL(1)
#else
#define BT_UNROLL(n)
#define BT_UNROLL_NOT
#endif

// By -ffast-math sums are added in another order in each width, and on one machine give other results than on the next.
#if defined(__clang__) && defined(__x86_64__)
#pragma float_control(push)
#pragma float_control(precise, on)
#elif defined(__GNUC__) && defined(__FAST_MATH__)
#pragma GCC push_options
#pragma GCC optimize("no-fast-math")
#endif

namespace btElasticPlastic
{
namespace
{
const double Huge = DBL_MAX;
/// A pivot below this share of the matrix' diagonal consists of rounding errors only.
const double LeastPivot = 4 * DBL_EPSILON;

const int SumWidth = 4;

// The kernels for every machine.
namespace Plain
{
#define BT_KERNEL
#if defined(__GNUC__)
#include "NarrowVector.inl"
#else
typedef double Vector;
const int Width = 1;
inline Vector broadcast(double a) { return a; }
inline Vector load(const double* p) { return *p; }
inline void store(double* p, Vector a) { *p = a; }
inline void storePart(double* p, Vector a, int) { *p = a; }
const int TileRows = 3, TileColumns = 3;
struct Sum
{
	double m_element[SumWidth];
};
inline void clear(Sum& sum) { sum = Sum(); }
inline void addProducts(Sum& sum, const double* a, const double* b)
{
	for (int i = 0; i < SumWidth; ++i)
		sum.m_element[i] += a[i] * b[i];
}
inline double total(const Sum& sum)
{
	return (sum.m_element[0] + sum.m_element[1]) + (sum.m_element[2] + sum.m_element[3]);
}
#endif
#include "BlockKernel.inl"
#undef BT_KERNEL
const BlockKernel Kernel = {factorise, solve, solveForward, 1};
}  // namespace Plain

#ifdef BT_KERNEL_X86
// From here on products are added without being rounded, which every processor with AVX2 can. All of these kernels add in the same
// order, and give the same bits.
namespace Fused
{
#define BT_KERNEL __attribute__((target("fma")))
#include "NarrowVector.inl"
#include "BlockKernel.inl"
#undef BT_KERNEL
const BlockKernel Kernel = {factorise, solve, solveForward, Width};
}  // namespace Fused

namespace Avx2
{
#define BT_KERNEL __attribute__((target("avx2,fma")))
typedef __m256d Vector;
const int Width = 4;
BT_KERNEL inline Vector broadcast(double a) { return _mm256_set1_pd(a); }
BT_KERNEL inline Vector load(const double* p) { return _mm256_loadu_pd(p); }
BT_KERNEL inline void store(double* p, Vector a) { _mm256_storeu_pd(p, a); }
BT_KERNEL inline void storePart(double* p, Vector a, int n)
{
	if (n == 2)
		_mm_storeu_pd(p, _mm256_castpd256_pd128(a));
	else
		store(p, a);
}
const int TileRows = 2, TileColumns = 6;
#include "WideSum.inl"
#include "BlockKernel.inl"
#undef BT_KERNEL
const BlockKernel Kernel = {factorise, solve, solveForward, Width};
}  // namespace Avx2

namespace Avx512
{
#define BT_KERNEL __attribute__((target("avx512f,avx2,fma")))
typedef __m512d Vector;
const int Width = 8;
BT_KERNEL inline Vector broadcast(double a) { return _mm512_set1_pd(a); }
BT_KERNEL inline Vector load(const double* p) { return _mm512_loadu_pd(p); }
BT_KERNEL inline void store(double* p, Vector a) { _mm512_storeu_pd(p, a); }
BT_KERNEL inline void storePart(double* p, Vector a, int n)
{
	_mm512_mask_storeu_pd(p, (unsigned char)((1u << n) - 1), a);
}
const int TileRows = 4, TileColumns = 6;
#include "WideSum.inl"
#include "BlockKernel.inl"
#undef BT_KERNEL
const BlockKernel Kernel = {factorise, solve, solveForward, Width};
}  // namespace Avx512
#endif
}  // namespace

const BlockKernel& BlockKernel::select(int maxWidth)
{
#ifdef BT_KERNEL_X86
	if (maxWidth >= Avx512::Width && __builtin_cpu_supports("avx512f"))
		return Avx512::Kernel;
	if (maxWidth >= Avx2::Width && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
		return Avx2::Kernel;
	if (maxWidth >= Fused::Width && __builtin_cpu_supports("fma"))
		return Fused::Kernel;
#endif
	(void)maxWidth;
	return Plain::Kernel;
}
}  // namespace btElasticPlastic

#if defined(__clang__) && defined(__x86_64__)
#pragma float_control(pop)
#elif defined(__GNUC__) && defined(__FAST_MATH__)
#pragma GCC pop_options
#endif

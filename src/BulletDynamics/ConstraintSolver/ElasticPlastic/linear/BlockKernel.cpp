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

namespace btElasticPlastic
{
namespace
{
const double Huge = DBL_MAX;
/// A pivot below this share of the matrix' diagonal consists of rounding errors only.
const double LeastPivot = 4 * DBL_EPSILON;

// The kernels for every machine.
namespace Baseline
{
#if defined(__GNUC__)
typedef double Vector __attribute__((vector_size(16)));
const int Width = 2;
inline Vector broadcast(double a) { return Vector{a, a}; }
inline double total(Vector a) { return a[0] + a[1]; }
#else
typedef double Vector;
const int Width = 1;
inline Vector broadcast(double a) { return a; }
inline double total(Vector a) { return a; }
#endif
inline Vector load(const double* p)
{
	Vector a;
	memcpy(&a, p, sizeof a);
	return a;
}
inline void store(double* p, Vector a) { memcpy(p, &a, sizeof a); }
inline void storePart(double* p, Vector a, int) { store(p, a); }
const int TileRows = 3, TileColumns = 3;
#define BT_KERNEL
#include "BlockKernel.inl"
#undef BT_KERNEL
const BlockKernel Kernel = {factorise, solve, Width};
}  // namespace Baseline

#ifdef BT_KERNEL_X86
namespace Avx2
{
#define BT_KERNEL __attribute__((target("avx2,fma")))
typedef __m256d Vector;
const int Width = 4;
BT_KERNEL inline Vector broadcast(double a) { return _mm256_set1_pd(a); }
BT_KERNEL inline double total(Vector a) { return (a[0] + a[1]) + (a[2] + a[3]); }
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
#include "BlockKernel.inl"
#undef BT_KERNEL
const BlockKernel Kernel = {factorise, solve, Width};
}  // namespace Avx2

namespace Avx512
{
#define BT_KERNEL __attribute__((target("avx512f,avx2,fma")))
typedef __m512d Vector;
const int Width = 8;
BT_KERNEL inline Vector broadcast(double a) { return _mm512_set1_pd(a); }
BT_KERNEL inline double total(Vector a) { return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7])); }
BT_KERNEL inline Vector load(const double* p) { return _mm512_loadu_pd(p); }
BT_KERNEL inline void store(double* p, Vector a) { _mm512_storeu_pd(p, a); }
BT_KERNEL inline void storePart(double* p, Vector a, int n)
{
	_mm512_mask_storeu_pd(p, (unsigned char)((1u << n) - 1), a);
}
const int TileRows = 4, TileColumns = 6;
#include "BlockKernel.inl"
#undef BT_KERNEL
const BlockKernel Kernel = {factorise, solve, Width};
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
#endif
	(void)maxWidth;
	return Baseline::Kernel;
}
}  // namespace btElasticPlastic

// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

// The source of a library that has precompiled headers and nothing else: tests use them together.

// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_H
#define EP_VIEWER_H

#include "cli/WindowOptions.h"
#include "drawing/ViewedScene.h"

namespace ep
{
/// Shows a scene in a window and lets a person drive, until the window is closed. Throws std::runtime_error.
void runViewer(ViewedScene& scene, const WindowOptions& options);

/// Is there a screen that a window can open on?
bool hasDisplay();
}  // namespace ep

#endif  // EP_VIEWER_H

// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/Brush.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace ep
{
namespace brush
{
namespace
{
const ImU32 DARK = IM_COL32(10, 15, 23, 158), WHITE = IM_COL32(245, 247, 250, 255);

bool theyGoIntoPanel = false;

ImVec2 at(int x, int y) { return ImVec2(float(x), float(y)); }

ImDrawList& target() { return theyGoIntoPanel ? *ImGui::GetWindowDrawList() : *ImGui::GetBackgroundDrawList(); }
}  // namespace

InPanel::InPanel() { theyGoIntoPanel = true; }
InPanel::~InPanel() { theyGoIntoPanel = false; }

unsigned shown(const Colour& linearLight, float alpha)
{
	const auto value = [](float light) { return std::pow(std::min(1.f, light * 1.3f), 1 / 2.2f); };
	return ImGui::ColorConvertFloat4ToU32(
		ImVec4(value(linearLight.r), value(linearLight.g), value(linearLight.b), alpha));
}

int scaled(int length) { return int(float(length) * ImGui::GetFontSize() / 18 + .5f); }

void rectangle(int x, int y, int width, int height, unsigned colour)
{
	target().AddRectFilled(at(x, y), at(x + width, y + height), colour);
}

void strip(float left, float leftTop, float leftBottom, float right, float rightTop, float rightBottom, unsigned colour)
{
	ImDrawList& list = target();
	// Smoothed edges would show between neighbours.
	const ImDrawListFlags flags = list.Flags;
	list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
	list.AddQuadFilled(ImVec2(left, leftTop), ImVec2(right, rightTop), ImVec2(right, rightBottom),
					   ImVec2(left, leftBottom), colour);
	list.Flags = flags;
}

void line(const std::vector<std::pair<float, float>>& points, unsigned colour)
{
	for (const auto& point : points)
		target().PathLineTo(ImVec2(point.first, point.second));
	target().PathStroke(colour, ImDrawFlags_None, ImGui::GetFontSize() / 12);
}

void panel(int x, int y, int width, int height) { rectangle(x, y, width, height, DARK); }

void write(int x, int y, const std::string& text)
{
	target().AddText(at(x, y - int(ImGui::GetFont()->Ascent)), WHITE, text.c_str());
}

int textWidth(const std::string& text) { return int(ImGui::CalcTextSize(text.c_str()).x + .5f); }
}  // namespace brush
}  // namespace ep

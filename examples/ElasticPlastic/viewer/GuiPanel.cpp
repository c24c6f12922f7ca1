// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/GuiPanel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "viewer/Brush.h"
#include "viewer/Chart.h"
#include "viewer/DrawFigure.h"
#include "viewer/Textures.h"

namespace ep
{
namespace
{
ImU32 shown(const Colour& colour) { return brush::shown(colour, 1); }
}  // namespace

GuiPanel::GuiPanel(const char* title, const Rectangle& place, bool moves, bool isFolded)
{
	const ImGuiCond when = moves ? ImGuiCond_Always : ImGuiCond_FirstUseEver;
	ImGui::SetNextWindowPos(ImVec2(place.x, place.y), when);
	ImGui::SetNextWindowSize(ImVec2(place.width, place.height), when);
	ImGui::SetNextWindowCollapsed(isFolded, when);
	ImGui::SetNextWindowBgAlpha(.82f);
	m_isOpen = ImGui::Begin(title);
	ImGui::PushItemWidth(-ImGui::GetFontSize() * 9.5f);
}

GuiPanel::~GuiPanel()
{
	ImGui::PopItemWidth();
	ImGui::End();
}

bool GuiPanel::section(const char* title, bool open)
{
	return m_isOpen && ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void GuiPanel::text(const std::string& line) { ImGui::TextWrapped("%s", line.c_str()); }

bool GuiPanel::button(const char* label) { return ImGui::Button(label); }

void GuiPanel::beside() { ImGui::SameLine(); }

bool GuiPanel::check(const char* label, bool& value) { return ImGui::Checkbox(label, &value); }

bool GuiPanel::choice(const char* label, size_t& index, const std::vector<std::string>& names)
{
	bool changed = false;
	if (!ImGui::BeginCombo(label, names[index].c_str()))
		return false;
	for (size_t i = 0; i < names.size(); ++i)
		if (ImGui::Selectable(names[i].c_str(), i == index) && i != index)
		{
			index = i;
			changed = true;
		}
	ImGui::EndCombo();
	return changed;
}

bool GuiPanel::slider(const char* label, double& value, double low, double high, const char* format)
{
	// Over more than a decade the small values want room too.
	const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp |
								   (low > 0 && high > 20 * low ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
	ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format, flags);
	return ImGui::IsItemDeactivatedAfterEdit();
}

bool GuiPanel::slider(const char* label, int& value, int low, int high)
{
	ImGui::SliderInt(
		label, &value, low, high, "%d",
		ImGuiSliderFlags_AlwaysClamp | (high > 20 * low ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None));
	return ImGui::IsItemDeactivatedAfterEdit();
}

void GuiPanel::shares(const std::vector<Share>& shares, const char* unit)
{
	double sum = 0;
	for (const Share& share : shares)
		sum += std::max(0., share.value);
	const ImVec2 from = ImGui::GetCursorScreenPos();
	const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFontSize() * .8f;
	float x = from.x;
	for (const Share& share : shares)
	{
		const float next = x + (sum > 0 ? float(std::max(0., share.value) / sum) * width : 0);
		ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(x, from.y), ImVec2(next, from.y + height),
												  shown(share.colour));
		x = next;
	}
	ImGui::Dummy(ImVec2(width, height));
	float right = 0;
	for (const Share& share : shares)
	{
		char text[96];
		std::snprintf(text, sizeof text, "%s %.*f %s", share.name, std::fabs(share.value) < 100 ? 1 : 0, share.value,
					  unit);
		const float size = ImGui::GetFontSize() * .7f, gap = ImGui::GetStyle().ItemSpacing.x;
		const float needed = size + gap + ImGui::CalcTextSize(text).x;
		// Beside the last one where there is room.
		if (right > 0 && right + 2 * gap + needed < from.x + width)
			ImGui::SameLine(0, 2 * gap);
		const ImVec2 place = ImGui::GetCursorScreenPos();
		ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(place.x, place.y + size * .3f),
												  ImVec2(place.x + size, place.y + size * 1.3f), shown(share.colour));
		ImGui::Dummy(ImVec2(size, size));
		ImGui::SameLine();
		ImGui::TextUnformatted(text);
		if (*share.help && ImGui::IsItemHovered())
			ImGui::SetTooltip("%s", share.help);
		right = place.x + needed;
	}
}

int GuiPanel::table(const char* name, const std::vector<std::string>& titles, const std::vector<Row>& rows,
					int selected)
{
	int clicked = -1;
	const ImGuiTableFlags flags =
		ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingFixedFit;
	if (!ImGui::BeginTable(name, int(titles.size()), flags))
		return clicked;
	// The first one, with names, has what others leave: they are never cut.
	for (size_t i = 0; i < titles.size(); ++i)
		ImGui::TableSetupColumn(titles[i].c_str(),
								i == 0 ? ImGuiTableColumnFlags_WidthStretch : ImGuiTableColumnFlags_WidthFixed);
	ImGui::TableHeadersRow();
	for (size_t r = 0; r < rows.size(); ++r)
	{
		ImGui::TableNextRow();
		for (size_t c = 0; c < rows[r].cells.size(); ++c)
		{
			ImGui::TableNextColumn();
			const char* const cell = rows[r].cells[c].c_str();
			if (c > 0)
			{
				ImGui::TextUnformatted(cell);
				continue;
			}
			ImGui::PushID(int(r));
			float height = 0;
			if (const Texture* const picture = textureOf(rows[r].picture))
			{
				height = 3 * ImGui::GetTextLineHeight();
				ImGui::Image(reinterpret_cast<ImTextureID>(std::uintptr_t(picture->name)),
							 ImVec2(height * float(picture->width) / float(picture->height), height));
			}
			else
			{
				ImGui::PushStyleColor(ImGuiCol_Text, shown(rows[r].colour));
				ImGui::TextUnformatted("\u25a0");
				ImGui::PopStyleColor();
			}
			ImGui::SameLine(0, 4);
			ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, ImVec2(0, .5f));
			if (ImGui::Selectable(cell, int(r) == selected, ImGuiSelectableFlags_SpanAllColumns, ImVec2(0, height)))
				clicked = int(r);
			ImGui::PopStyleVar();
			ImGui::PopID();
		}
	}
	ImGui::EndTable();
	return clicked;
}

void GuiPanel::plot(const char* title, const Curve& curve)
{
	const std::vector<float>& values = curve.values;
	char text[160];
	std::snprintf(text, sizeof text, "%s  %.4g %s", title, values.empty() ? 0. : double(values.back()), curve.unit);
	ImGui::TextUnformatted(text);
	const ImVec2 from = ImGui::GetCursorScreenPos();
	const int width = int(ImGui::GetContentRegionAvail().x), height = int(5.2f * ImGui::GetFontSize());
	ImGui::Dummy(ImVec2(float(width), float(height)));
	const brush::InPanel inPanel;
	Chart chart;
	chart.xUnit = "s";
	chart.limit = float(curve.limit);
	for (size_t i = 0; i < values.size(); ++i)
		chart.x.push_back(float(curve.step * (double(i) + 1 - double(values.size()))));
	chart.lines.push_back({{.8f, .8f, .8f}, values});
	drawChart(chart, {int(from.x), int(from.y), width, height});
}

void GuiPanel::figure(const Figure& figure)
{
	ImGui::TextUnformatted(figure.title.c_str());
	const ImVec2 from = ImGui::GetCursorScreenPos();
	const int width = int(ImGui::GetContentRegionAvail().x), height = int(8 * ImGui::GetFontSize());
	ImGui::Dummy(ImVec2(float(width), float(height)));
	const brush::InPanel inPanel;
	drawFigure(figure, {int(from.x), int(from.y), width, height});
}
}  // namespace ep

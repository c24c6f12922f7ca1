// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/GuiPanel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "viewer/Brush.h"

namespace ep
{
namespace
{
ImU32 shown(const Colour& colour) { return brush::shown(colour, 1); }
}  // namespace

GuiPanel::GuiPanel(const char* title, const Rectangle& place, bool moves)
{
	const ImGuiCond when = moves ? ImGuiCond_Always : ImGuiCond_FirstUseEver;
	ImGui::SetNextWindowPos(ImVec2(place.x, place.y), when);
	ImGui::SetNextWindowSize(ImVec2(place.width, place.height), when);
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

void GuiPanel::text(const std::string& line) { ImGui::TextUnformatted(line.c_str()); }

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
	for (size_t i = 0; i < shares.size(); ++i)
	{
		if (i % 2)
			ImGui::SameLine(width / 2);
		const ImVec2 place = ImGui::GetCursorScreenPos();
		const float size = ImGui::GetFontSize() * .7f;
		ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(place.x, place.y + size * .3f),
												  ImVec2(place.x + size, place.y + size * 1.3f),
												  shown(shares[i].colour));
		ImGui::Dummy(ImVec2(size, size));
		ImGui::SameLine();
		ImGui::Text("%s %.1f %s", shares[i].name, shares[i].value, unit);
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
	for (const std::string& title : titles)
		ImGui::TableSetupColumn(title.c_str());
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
			ImGui::PushStyleColor(ImGuiCol_Text, shown(rows[r].colour));
			ImGui::TextUnformatted("\u25a0");
			ImGui::PopStyleColor();
			ImGui::SameLine(0, 4);
			if (ImGui::Selectable(cell, int(r) == selected, ImGuiSelectableFlags_SpanAllColumns))
				clicked = int(r);
			ImGui::PopID();
		}
	}
	ImGui::EndTable();
	return clicked;
}

void GuiPanel::plot(const char* title, const std::vector<float>& values, const char* unit)
{
	float low = 0, high = 0;
	for (float value : values)
	{
		low = std::min(low, value);
		high = std::max(high, value);
	}
	char text[160];
	std::snprintf(text, sizeof text, "%s  %.4g %s  (%.3g to %.3g)", title, values.empty() ? 0. : double(values.back()),
				  unit, double(low), double(high));
	ImGui::TextUnformatted(text);
	ImGui::PushID(title);
	ImGui::PlotLines("##plot", values.data(), int(values.size()), 0, nullptr, low, high > low ? high : low + 1,
					 ImVec2(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 3));
	ImGui::PopID();
}
}  // namespace ep

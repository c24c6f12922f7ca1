// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_VIEWER_GUI_PANEL_H
#define EP_VIEWER_GUI_PANEL_H

#include "drawing/Panel.h"

namespace ep
{
/// A panel in a window of Dear ImGui, for as long as it lives within a frame.
class GuiPanel : public Panel
{
public:
	struct Rectangle
	{
		float x, y, width, height;
	};

	/// Pixels from the window's top left corner.
	/// \param moves  to there now; else it stays where a person has put it
	/// \param isFolded  at first: only its title is seen
	GuiPanel(const char* title, const Rectangle& place, bool moves, bool isFolded);
	~GuiPanel() override;

	/// False when folded.
	bool isOpen() const { return m_isOpen; }

	bool section(const char* title, bool open) override;
	void text(const std::string& line) override;
	bool button(const char* label) override;
	void beside() override;
	bool check(const char* label, bool& value) override;
	bool choice(const char* label, size_t& index, const std::vector<std::string>& names) override;
	bool slider(const char* label, double& value, double low, double high, const char* format) override;
	bool slider(const char* label, int& value, int low, int high) override;
	void shares(const std::vector<Share>& shares, const char* unit) override;
	int table(const char* name, const std::vector<std::string>& titles, const std::vector<Row>& rows,
			  int selected) override;
	void plot(const char* title, const Curve& curve) override;
	void figure(const Figure& figure) override;

private:
	bool m_isOpen;
};
}  // namespace ep

#endif  // EP_VIEWER_GUI_PANEL_H

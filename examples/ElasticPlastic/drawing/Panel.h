// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_PANEL_H
#define EP_PANEL_H

#include <string>
#include <vector>

#include "drawing/Drawing.h"
#include "drawing/Figure.h"
#include "text/Named.h"

namespace ep
{
/// What a scene has beside its picture: numbers to read, settings to change. Called anew for each picture; what returns bool
/// tells whether a person has just changed or pressed it. Scenes know no more of windows.
class Panel
{
public:
	virtual ~Panel() = default;

	/// What follows belongs to it. \return whether it is open; if not, leave it out
	virtual bool section(const char* title, bool open) = 0;

	virtual void text(const std::string& line) = 0;
	virtual bool button(const char* label) = 0;
	/// What comes next stands beside what came last.
	virtual void beside() = 0;
	virtual bool check(const char* label, bool& value) = 0;
	virtual bool choice(const char* label, size_t& index, const std::vector<std::string>& names) = 0;
	/// True once, when the person lets go. \param format  as of printf
	virtual bool slider(const char* label, double& value, double low, double high, const char* format) = 0;
	virtual bool slider(const char* label, int& value, int low, int high) = 0;

	struct Share
	{
		const char* name;
		Colour colour;
		double value;
		const char* help = "";  ///< under the mouse
	};
	/// A bar in parts.
	virtual void shares(const std::vector<Share>& shares, const char* unit) = 0;

	struct Row
	{
		Colour colour;
		std::vector<std::string> cells;
		std::string picture = {};  ///< a PNG file in place of the colour's mark; empty or missing: none
	};
	/// \return the row that was clicked, -1: none
	virtual int table(const char* name, const std::vector<std::string>& titles, const std::vector<Row>& rows,
					  int selected) = 0;

	struct Curve
	{
		const std::vector<float>& values;  ///< the last one now
		double step;                       ///< from one to the next [s]
		const char* unit;
		double limit = 0;  ///< where it yields, to both sides; 0: nowhere
	};
	virtual void plot(const char* title, const Curve& curve) = 0;

	virtual void figure(const Figure& figure) = 0;
};

/// A choice among named things, of which the value is one.
template <class Value>
bool choice(Panel& panel, const char* label, Value& value, const std::vector<Named<Value>>& choices)
{
	size_t index = 0;
	while (!(choices[index].value == value))
		++index;
	const bool changed = panel.choice(label, index, namesOf(choices));
	value = choices[index].value;
	return changed;
}
}  // namespace ep

#endif  // EP_PANEL_H

// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_TEST_SILENT_PANEL_H
#define EP_TEST_SILENT_PANEL_H

#include "drawing/Panel.h"

/// A panel in which all is open and nobody does anything.
struct SilentPanel : ep::Panel
{
	bool section(const char*, bool) override { return true; }
	void text(const std::string&) override {}
	bool button(const char*) override { return false; }
	void beside() override {}
	bool check(const char*, bool&) override { return false; }
	bool choice(const char*, size_t&, const std::vector<std::string>&) override { return false; }
	bool slider(const char*, double&, double, double, const char*) override { return false; }
	bool slider(const char*, int&, int, int) override { return false; }
	void shares(const std::vector<Share>&, const char*) override {}
	int table(const char*, const std::vector<std::string>&, const std::vector<Row>&, int) override { return -1; }
	void plot(const char*, const Curve&) override {}
	void figure(const ep::Figure&) override {}
};

#endif  // EP_TEST_SILENT_PANEL_H

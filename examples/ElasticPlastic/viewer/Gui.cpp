// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#include "viewer/Gui.h"

#include <imgui.h>
#include <imgui_impl_glut.h>
#include <imgui_impl_opengl2.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "viewer/Gl.h"
#include "viewer/Keys.h"

namespace ep
{
namespace
{
/// A line's height that a person at arm's length can read: 17 pixels at 96 pixels an inch.
float readableSize()
{
	const int pixels = glutGet(GLUT_SCREEN_WIDTH), millimetres = glutGet(GLUT_SCREEN_WIDTH_MM);
	const float perInch = millimetres > 0 ? float(pixels) / float(millimetres) * 25.4f : 96;
	return 17 * std::max(1.f, std::min(3.f, perInch / 96));
}

void loadFont(float size)
{
	ImGuiIO& io = ImGui::GetIO();
	// Latin, and the square that marks a row.
	static const ImWchar ranges[] = {0x20, 0xff, 0x25a0, 0x25a0, 0};
	for (const char* file : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
							 "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
							 "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"})
		if (std::filesystem::exists(file) && io.Fonts->AddFontFromFileTTF(file, size, nullptr, ranges))
			return;
	// Dear ImGui's own is made of pixels.
	ImFontConfig config;
	config.SizePixels = 13 * std::max(1.f, std::floor(size / 13 + .3f));
	io.Fonts->AddFontDefault(&config);
}
}  // namespace

Gui::Gui(float textSize)
{
	IMGUI_CHECKVERSION();
	ImGui::CreateContext();
	ImGuiIO& io = ImGui::GetIO();
	io.IniFilename = nullptr;  // nothing is left behind
	const float size = textSize > 0 ? textSize : readableSize();
	loadFont(size);
	ImGui::StyleColorsDark();
	ImGui::GetStyle().ScaleAllSizes(size / 17);
	ImGui::GetStyle().WindowRounding = 5;
	ImGui_ImplGLUT_Init();
	ImGui_ImplOpenGL2_Init();
}

Gui::~Gui()
{
	ImGui_ImplOpenGL2_Shutdown();
	ImGui_ImplGLUT_Shutdown();
	ImGui::DestroyContext();
}

void Gui::begin(int width, int height)
{
	ImGui_ImplOpenGL2_NewFrame();
	ImGui::GetIO().DisplaySize = ImVec2(float(std::max(1, width)), float(std::max(1, height)));
	takeClicks();
	ImGui_ImplGLUT_NewFrame();
}

/// A button that goes down and up between two pictures is down in one and up in the next: else nobody would see the click.
void Gui::takeClicks()
{
	unsigned changed = 0;
	while (!m_clicks.empty())
	{
		const Click click = m_clicks.front();
		if (changed >> click.button & 1u)
			return;
		changed |= 1u << click.button;
		ImGui_ImplGLUT_MouseFunc(click.button, click.down ? GLUT_DOWN : GLUT_UP, click.x, click.y);
		m_clicks.pop_front();
	}
}

void Gui::end()
{
	ImGui::Render();
	ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::key(int key, bool down)
{
	const int x = 0, y = 0;
	if (key >= Keys::SPECIAL)
		(down ? ImGui_ImplGLUT_SpecialFunc : ImGui_ImplGLUT_SpecialUpFunc)(key - Keys::SPECIAL, x, y);
	else
		(down ? ImGui_ImplGLUT_KeyboardFunc : ImGui_ImplGLUT_KeyboardUpFunc)(static_cast<unsigned char>(key), x, y);
	return ImGui::GetIO().WantTextInput;
}

bool Gui::mouseButton(int button, bool down, int x, int y)
{
	const int wheelUp = 3, wheelDown = 4;
	if (button == wheelUp || button == wheelDown)
	{
		if (down)
			ImGui_ImplGLUT_MouseWheelFunc(0, button == wheelUp ? 1 : -1, x, y);
	}
	else if (button < wheelUp)
		m_clicks.push_back({button, down, x, y});
	return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::mouseMove(int x, int y)
{
	ImGui_ImplGLUT_MotionFunc(x, y);
	return ImGui::GetIO().WantCaptureMouse;
}
}  // namespace ep

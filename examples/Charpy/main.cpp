#include <cstdio>
#include <iostream>

#include "CharpyOptions.h"
#include "CharpyReport.h"

int main(int argc, char** argv)
{
	CLI::App app("Charpy: a pendulum hammer strikes a notched specimen");
	bool headless = false;
	std::string out = "charpy-output";
	ep::CharpyOptions options(app);
	app.add_flag("--headless", headless, "No window: one line on the terminal, summary.json and energy.csv");
	app.add_option("--out", out, "Directory for what is left")->capture_default_str();
	CLI11_PARSE(app, argc, argv);
	try
	{
		std::printf("%s\n", toLine(ep::runAndReport(options.settings(), out)).c_str());
	}
	catch (const std::exception& error)
	{
		std::cerr << "charpy: " << error.what() << "\n";
		return 1;
	}
}

#include <cstdio>
#include <iostream>

#include "CharpyOptions.h"
#include "CharpyReport.h"
#include "CharpyStudies.h"

namespace
{
struct Options
{
	explicit Options(CLI::App& app) : scene(app)
	{
		app.add_flag("--headless", headless, "No window: one line on the terminal, summary.json and energy.csv");
		app.add_option("--out", out, "Directory for what is left")->capture_default_str();
		std::vector<std::string> names = {"all"};
		std::string help = "Many tests with these settings, their results as a table, CSV and SVG: all";
		for (const ep::CharpyStudy& s : ep::charpyStudies())
		{
			names.push_back(s.name);
			help += std::string("; ") + s.name + ": " + s.help;
		}
		app.add_option("--study", study, help)->check(CLI::IsMember(names));
	}

	ep::CharpyOptions scene;
	bool headless = false;
	std::string out = "charpy-output";
	std::string study;
};

void runStudies(const Options& o)
{
	const ep::CharpySettings settings = o.scene.settings();
	ep::makeDirectory(o.out);
	for (const ep::CharpyStudy& study : ep::charpyStudies())
		if (o.study == "all" || o.study == study.name)
		{
			const ep::CharpyTable table = study.run(settings);
			std::printf("%s", table.toText().c_str());
			std::printf("  in %s\n\n", ep::writeTable(table, o.out).c_str());
			std::fflush(stdout);
		}
}
}  // namespace

int main(int argc, char** argv)
{
	CLI::App app("Charpy: a pendulum hammer strikes a notched specimen that bends, or breaks");
	Options options(app);
	CLI11_PARSE(app, argc, argv);
	try
	{
		if (!options.study.empty())
			runStudies(options);
		else
			std::printf("%s\n", toLine(ep::runAndReport(options.scene.settings(), options.out)).c_str());
	}
	catch (const std::exception& error)
	{
		std::cerr << "charpy: " << error.what() << "\n";
		return 1;
	}
}

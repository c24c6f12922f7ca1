#include "Pictures.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "Judgement.h"
#include "plot.h"

namespace ep
{
double errorAtGamesStep(const Selection& records, const std::string& family)
{
	for (const Record* r : records)
		if (r->family() == family && r->substeps == 1 && std::lround(1 / r->dt) == 60 && r->iterations == 10 &&
			(r->isOutside() || (r->jointClass == "spring2" && r->precision == "float")) &&
			(r->budget == 0 || r->budget == 0.01))
			return r->error;
	return NAN;
}

namespace
{
/// Lines that fit a column.
std::vector<std::string> wrapped(const std::string& text)
{
	std::vector<std::string> lines(1);
	std::istringstream words(text);
	for (std::string word; words >> word;)
		if (lines.back().size() + word.size() < 15)
			lines.back() += (lines.back().empty() ? "" : " ") + word;
		else
			lines.push_back(word);
	return lines;
}
}  // namespace

std::string overviewPicture(const ByProblem& problems)
{
	const int left = 170, top = 96, column = 112, row = 24;
	const std::vector<Family> compared = familiesOf(problems);
	const int width = left + column * int(compared.size()) + 8, height = top + row * int(problems.names.size()) + 8;
	std::ostringstream out;
	out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << " " << height << "\" width=\""
		<< width << "\" height=\"" << height << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\""
		<< width << "\" height=\"" << height << "\" fill=\"#fff\"/>\n<text x=\"8\" y=\"22\" font-size=\"16\" "
		<< "font-weight=\"bold\">Relative error at 1/60 s, 10 iterations where solvers iterate; only the profile, for "
		   "1 %, takes "
		   "substeps</text>\n";
	int x = left;
	for (const Family& family : compared)
	{
		int y = 46;
		for (const std::string& line : wrapped(family.name))
		{
			out << "<text x=\"" << x + column / 2 << "\" y=\"" << y << "\" text-anchor=\"middle\">" << line
				<< "</text>\n";
			y += 15;
		}
		x += column;
	}
	int y = top;
	for (const std::string& name : problems.names)
	{
		out << "<text x=\"8\" y=\"" << y + 16 << "\">" << name << "</text>\n";
		x = left;
		for (const Family& family : compared)
		{
			const double error = errorAtGamesStep(problems.records.at(name), family.key);
			out << "<rect x=\"" << x + 1 << "\" y=\"" << y + 1 << "\" width=\"" << column - 2 << "\" height=\""
				<< row - 2 << "\" fill=\"" << shadeOf(error) << "\"/><text x=\"" << x + column / 2 << "\" y=\""
				<< y + 16 << "\" text-anchor=\"middle\">" << (std::isnan(error) ? "" : percent(error)) << "</text>\n";
			x += column;
		}
		y += row;
	}
	out << "</svg>\n";
	return out.str();
}

Selection comparedOf(const Selection& records)
{
	Selection compared;
	for (const Record* r : records)
		for (const Family& family : families())
			if (r->family() == family.key)
				compared.push_back(r);
	return compared;
}

std::string problemPicture(const std::string& name, const Selection& records)
{
	Plot plot;
	plot.m_title = name;
	plot.m_xLabel = "run time per simulated second [s]";
	plot.m_yLabel = "relative error";
	plot.m_logX = plot.m_logY = true;
	int color = 0;
	for (const Family& family : families())
	{
		Plot::Curve curve{family.name, {}, Plot::MARKS, color++, {}};
		for (const Record* r : records)
			if (r->family() == family.key && std::isfinite(r->error))
			{
				// Below what a picture can tell, and above what is of any use, all are the same.
				curve.m_points.emplace_back(r->cost(), std::min(std::max(r->error, 1e-6), 1e2));
				curve.m_tips.push_back(r->setting() + ": " + percent(r->error));
			}
		if (!curve.m_points.empty())
			plot.m_curves.push_back(curve);
	}
	Plot::Curve front{"nothing better and quicker", {}, Plot::RINGS, 7, {}};
	for (const Record* r : nonDominated(records))
		front.m_points.emplace_back(r->cost(), std::min(std::max(r->error, 1e-6), 1e2));
	plot.m_curves.push_back(front);
	return plot.svg();
}

}  // namespace ep

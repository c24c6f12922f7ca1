#ifndef EP_REPORT_HTML_PARTS_H
#define EP_REPORT_HTML_PARTS_H

#include <ostream>
#include <string>
#include <vector>

#include "ByProblem.h"

namespace ep
{
/// What is compared, as readers know it.
struct Family
{
	const char* key;  ///< Record::family()
	const char* name;
};
const std::vector<Family>& families();
/// Those that have a record.
std::vector<Family> familiesOf(const ByProblem& problems);

std::string percent(double share);
std::string milliseconds(double seconds);

/// Green to red by the error's order of magnitude, grey for none.
const char* shadeOf(double error);

/// A cell of a table with an error, green to red by the error's order of magnitude.
std::string cell(double error);

// The page's parts, from the top.
void writeOverview(std::ostream& out, const ByProblem& problems);
void writeProfiles(std::ostream& out, const ByProblem& problems);
void writeParts(std::ostream& out, const ByProblem& problems);
void writeStability(std::ostream& out, const std::vector<TrialRecord>& trials);
void writeProblem(std::ostream& out, const std::string& name, const Selection& records);
}  // namespace ep

#endif  // EP_REPORT_HTML_PARTS_H

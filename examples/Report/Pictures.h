#ifndef EP_REPORT_PICTURES_H
#define EP_REPORT_PICTURES_H

#include <string>

#include "HtmlParts.h"

namespace ep
{
/// All problems by all families at the game's step, in one look: a row a problem, colour and number the error.
std::string overviewPicture(const ByProblem& problems);

/// What is compared: without what the profile and the study of parts made, which have tables of their own.
Selection comparedOf(const Selection& records);

/// Error over run time of what is compared.
std::string problemPicture(const std::string& name, const Selection& records);

/// The error of one record that stands for a family at 1/60 s, 10 iterations, float, or of another engine; not a number if there is none.
double errorAtGamesStep(const Selection& records, const std::string& family);
}  // namespace ep

#endif  // EP_REPORT_PICTURES_H

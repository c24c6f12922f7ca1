#ifndef EP_SUMMARY_H
#define EP_SUMMARY_H

#include <string>

#include "Demolisher.h"

namespace ep
{
/// The summary in JSON, units in the names.
std::string toJson(const DemolisherSummary& summary, const DemolisherSettings& settings);
}  // namespace ep

#endif  // EP_SUMMARY_H

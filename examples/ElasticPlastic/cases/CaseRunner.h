// SPDX-FileCopyrightText: 2026 Bullet Elastic-Plastic contributors
// SPDX-License-Identifier: Zlib

#ifndef EP_CASE_RUNNER_H
#define EP_CASE_RUNNER_H

#include <functional>
#include <string>
#include <vector>

namespace ep
{
/// What a process of its own computes.
struct CaseJob
{
	std::string name;     ///< for messages, and for files
	std::string product;  ///< name of the file or folder that is there when it has been computed

	/// Of the shell. \param part  under which the process is to make the product: it gets its name when it is whole
	std::function<std::string(const std::string& part)> command;
};

/// Computes those jobs whose product is not in the folder, each in a process of its own; tells how far it is on standard output. What
/// a job says is kept in a file "<name>.log"; one that fails leaves that in a file "<name>.failed", and is tried again the next time.
/// \param parallel  how many at the same time
/// \return how many have failed; an interrupt (Ctrl-C) is thrown as a std::runtime_error
int runCases(const std::vector<CaseJob>& jobs, const std::string& folder, int parallel);

/// A text as one word of the shell.
std::string shellWord(const std::string& text);

/// Which of a number of cases are mine. \param shard  "i/n": every n-th from the i-th, 1 to n; empty: all. Throws a
/// std::runtime_error if it is something else
std::vector<size_t> shardOf(size_t cases, const std::string& shard);

/// Of the running program. \param self  what it was called by
std::string programFolder(const char* self);
}  // namespace ep

#endif  // EP_CASE_RUNNER_H

// Files on disk as text or bytes: read whole, and written whole or not at all.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace galet {

/// Writes `bytes` under a temporary name in the same folder, flushes them to the disk, and renames: a reader sees
/// the earlier file or the complete new one, also after a crash. (A path that exists and is no regular file, such
/// as /dev/stdout, is written to directly.) Throws RunError with the path and the system's reason.
void write_file(const std::string& path, std::string_view bytes);

/// The whole content of a file. Throws InputError with the path and the system's reason.
std::string read_file(const std::string& path);

/// A word of a line, with the column (from 1) where it starts.
struct Word {
  std::string_view text;
  int column = 1;
};

/// The words of a line, separated by blanks.
std::vector<Word> split_words(std::string_view line);

/// The lines of a text, without their line ends ("\n" or "\r\n").
std::vector<std::string_view> split_lines(std::string_view text);

std::string_view trim(std::string_view text);

/// The number that `text` spells, if it is one number and nothing else. "nan" and "inf" count as numbers.
std::optional<double> parse_real(std::string_view text);
std::optional<long> parse_integer(std::string_view text);

}  // namespace galet

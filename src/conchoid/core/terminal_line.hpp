#pragma once

#include <string_view>

namespace conchoid::terminal {

/// Whether stderr is a terminal a person looks at.
bool interactive();
/// Shows `text` as the line that is overwritten next time (progress); cut to the terminal's width.
void show(std::string_view text);
/// Takes that line away.
void clear();
/// Writes a lasting line; the line shown by show() reappears below it.
void print(std::string_view text);

}  // namespace conchoid::terminal

// SPDX-License-Identifier: Apache-2.0
// The manual says what the programs say, no less and no more, and its readers can read it.
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/config.h"
#include "support/project_folder.h"
#include "support/run_program.h"

namespace darkling {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Not;

using Words = std::set<std::string>;

std::string page_of(const std::string& name) {
  return test::project_folder() + "/deploy/man/" + name;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The first part of every match of `pattern` in a line.
Words matches_in(const std::vector<std::string>& lines, const std::string& pattern) {
  const std::regex expression(pattern);
  Words found;
  for (const std::string& line : lines) {
    const std::sregex_iterator end;
    for (std::sregex_iterator match(line.begin(), line.end(), expression); match != end; ++match) {
      found.insert((*match)[1]);
    }
  }
  return found;
}

// The lines of a page by the subsection they are in, named by its first word; "" before the first
// and in a section without any.
std::map<std::string, std::vector<std::string>> sections_of(const std::string& page) {
  std::map<std::string, std::vector<std::string>> sections;
  std::string name;
  for (const std::string& line : lines_of(page)) {
    if (line.starts_with(".SH ")) name = line == ".SH EXIT STATUS" ? "EXIT STATUS" : "";
    if (line.starts_with(".SS ")) name = line.substr(4, line.find(' ', 4) - 4);
    sections[name].push_back(line);
  }
  return sections;
}

// Of the tags of a page, which follow .TP.
Words options_in_page(const std::vector<std::string>& lines) {
  Words options;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i - 1] != ".TP") continue;
    options.merge(matches_in({lines[i]}, R"((?:^|[ ,"])(\\-\\-[a-z\\-]+))"));
  }
  Words plain;
  for (const std::string& option : options) {
    plain.insert(std::regex_replace(option, std::regex(R"(\\-)"), "-"));
  }
  return plain;
}

Words exit_codes_in_page(const std::vector<std::string>& lines) {
  return matches_in(lines, R"(^\.B ([0-9]+)$)");
}

std::string help_of(const std::vector<std::string>& words) {
  std::vector<std::string> asked = words;
  asked.emplace_back("--help");
  const auto run = test::run_program(asked);
  EXPECT_EQ(run.status, 0) << run.err;
  return run.out;
}

Words options_in_help(const std::string& help) {
  return matches_in(lines_of(help), R"(^  (?:-[a-z],)?(--[a-z-]+))");
}

Words exit_codes_in_help(const std::string& help) {
  return matches_in(lines_of(help.substr(help.find("Exit codes:"))), R"((?:^|  )([0-9]+) [a-z])");
}

TEST(ManPageOfTheService, HasTheOptionsAndExitCodesOfItsHelp) {
  const auto page = sections_of(test::read_text(page_of("darklingd.8")));
  const std::string help = help_of({DARKLINGD_PROGRAM});
  EXPECT_EQ(options_in_page(page.at("")), options_in_help(help));
  EXPECT_EQ(exit_codes_in_page(page.at("EXIT STATUS")), exit_codes_in_help(help));
  EXPECT_THAT(exit_codes_in_help(help), Contains("78"));
}

#ifdef DARKLING_PROGRAM
TEST(ManPageOfTheDeskTool, HasTheVerbsTheirOptionsAndExitCodesOfItsHelp) {
  const auto page = sections_of(test::read_text(page_of("darkling.1")));
  const std::string help = help_of({DARKLING_PROGRAM});
  EXPECT_EQ(options_in_page(page.at("")), options_in_help(help));
  EXPECT_EQ(exit_codes_in_page(page.at("EXIT STATUS")), exit_codes_in_help(help));
  EXPECT_THAT(exit_codes_in_help(help), Contains("130"));

  const Words verbs = matches_in(lines_of(help.substr(help.find("Verbs:"))), "^  ([a-z]+)   ");
  EXPECT_THAT(verbs, Contains("replay"));
  Words verbs_in_page;
  for (const auto& [name, lines] : page) {
    if (!name.empty() && std::islower(static_cast<unsigned char>(name[0]))) {
      verbs_in_page.insert(name);
    }
  }
  EXPECT_EQ(verbs_in_page, verbs);
  for (const std::string& verb : verbs) {
    ASSERT_THAT(page, Contains(Key(verb)));
    EXPECT_EQ(options_in_page(page.at(verb)), options_in_help(help_of({DARKLING_PROGRAM, verb})))
        << verb;
  }
}
#endif

// Else the comparisons above would be of nothing with nothing.
TEST(ManPages, AreReadForWhatTheySay) {
  const auto page = sections_of(
      ".SH VERBS\n.SS play \\fR[x]\n.TP\n.BR \\-h \", \" \\-\\-help\n.TP\n.BI \\-\\-truth\\-noise "
      "\" A\"\nAs \\-\\-other.\n.SH EXIT STATUS\n.TP\n.B 64\n");
  EXPECT_EQ(options_in_page(page.at("play")), (Words{"--help", "--truth-noise"}));
  EXPECT_EQ(exit_codes_in_page(page.at("EXIT STATUS")), Words{"64"});
  EXPECT_EQ(options_in_help("  -h,--help     Print\n  --a-b FILE   As --other\nnot --this\n"),
            (Words{"--help", "--a-b"}));
  EXPECT_EQ(exit_codes_in_help("8 x\nExit codes:\n  0 done   64 usage, or 2\n"),
            (Words{"0", "64"}));
}

class InstalledManPages : public ::testing::Test {
 protected:
  InstalledManPages() {
    const auto run = test::run_program({DARKLING_CMAKE, "--install", DARKLING_BUILD_DIR,
                                        "--component", "service", "--prefix", folder_.path()});
    EXPECT_EQ(run.status, 0) << run.err;
  }

  // What the tool complains of in each of the pages.
  void expect_silence(const std::string& tool, const std::string& command) const {
    const auto shell = [](const std::string& line) {
      return test::run_program({"/bin/sh", "-c", line});
    };
    if (shell("command -v " + tool).status != 0) GTEST_SKIP() << tool << " is not installed";
    for (const std::string& page : {page_of("darkling.1"), page_of("darklingd.8"), config_page()}) {
      const auto run = shell(command + " '" + page + "' 2>&1 >/dev/null");
      EXPECT_THAT(run.out, IsEmpty()) << page;
    }
    test::write_text(folder_ / "broken.1", ".TH X 1 2026-01-01\n.SH NAME\nx \\- y\n.NOSUCH\n");
    EXPECT_THAT(shell(command + " '" + (folder_ / "broken.1") + "' 2>&1 >/dev/null").out,
                HasSubstr("NOSUCH"));
  }
  [[nodiscard]] std::string config_page() const {
    return folder_ / "share/man/man5/darkling.yaml.5";
  }

  test::TemporaryFolder folder_;
};

TEST_F(InstalledManPages, AreWithoutFaultForMan) {
  expect_silence("man", "LC_ALL=C.UTF-8 man --warnings -Tutf8 -l");
}

TEST_F(InstalledManPages, AreWithoutFaultForMandoc) {
  expect_silence("mandoc", "mandoc -T utf8 -W warning");
}

TEST_F(InstalledManPages, ExplainEveryKeyOfTheConfigurationInItsOrder) {
  const std::string page = test::read_text(config_page());
  std::size_t at = 0;
  for (const ConfigKey& key : config_keys()) {
    const std::size_t found = page.find("\n.B " + std::string(key.name) + ": ", at);
    ASSERT_NE(found, std::string::npos) << key.name;
    at = found + 1;
  }
  EXPECT_EQ(matches_in(lines_of(page), R"(^\.B ([a-z0-9_]+):)").size(), config_keys().size());
  EXPECT_THAT(page, HasSubstr(".B width_px: \\fI320\\fR\nWidth of the thumbnail"));
  EXPECT_THAT(page, HasSubstr("Allowed: 64 to 1280 px or 0.\n"));
  EXPECT_THAT(page, Not(HasSubstr("\n# ")));
}

}  // namespace
}  // namespace darkling

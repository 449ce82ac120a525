// SPDX-License-Identifier: BSD-3-Clause
// Files, places, libraries, and the faults of phase 3. True at any number of ranks.
#include "deck/Deck.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "SmallScene.hpp"
#include "common/Parallel.hpp"
#include "common/Sha256.hpp"

namespace DeckTest {

using namespace tooljoint;
using namespace tooljoint::deck;
using namespace tooljoint::deck::test;

/// A separate folder for each test, made by rank 0 and known to all ranks.
class DeckFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    if (parallel::rank() == 0) {
      folder_ =
          (std::filesystem::temp_directory_path() / ("tooljoint_deck_" + std::to_string(getpid())))
              .string();
      std::filesystem::create_directories(folder_);
    }
    parallel::broadcast(folder_, 0);
  }
  void TearDown() override {
    parallel::sum(0.0);  // nobody still reads
    if (parallel::rank() == 0) std::filesystem::remove_all(folder_);
  }
  std::string write(const std::string& name, const std::string& text) const {
    const std::string file = folder_ + "/" + name;
    if (parallel::rank() == 0) std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  std::string folder_;
};

const std::string good = deckWith(stiffness, endTime);

TEST_F(DeckFiles, AreReadWithTextHashAndFolder) {
  const std::string file = write("scene one.xml", good);
  const Deck deck = Deck::read(file, smallScene());
  EXPECT_EQ(deck.text(), good);
  EXPECT_EQ(deck.sha256(), sha256(good));
  EXPECT_EQ(deck.file(), file);
  EXPECT_EQ(deck.folder(), folder_);
  EXPECT_EQ(deck.where("Contact/Stiffness"), file + ":3: /well/Contact/Stiffness");
}

TEST_F(DeckFiles, OverridesDoNotChangeTheTextOrItsHash) {
  const std::string file = write("a.xml", good);
  EXPECT_EQ(Deck::read(file, smallScene(), {"Transient/Samples=3"}).sha256(), sha256(good));
}

TEST_F(DeckFiles, FaultsAreTheSameOnEveryRank) {
  const std::string file =
      write("bad.xml", deckWith(parameter("Stiffnes", "double", "1"), endTime));
  const std::string fault = messageOf([&] { Deck::read(file, smallScene()); });
  EXPECT_EQ(fault.find(file + ":2: /well/Contact/Stiffness is required"), 0U) << fault;
  std::string first = fault;
  parallel::broadcast(first, 0);
  EXPECT_EQ(fault, first);
}

TEST_F(DeckFiles, AMissingFileIsAFileError) {
  const std::string file = folder_ + "/nothing.xml";
  EXPECT_EQ(messageOf([&] { Deck::read(file, smallScene()); }),
            "FileError: " + file + " cannot be read: No such file or directory.");
}

TEST_F(DeckFiles, AFolderIsAFileError) {
  EXPECT_EQ(messageOf([&] { Deck::read(folder_, smallScene()); }),
            "FileError: " + folder_ + " cannot be read: it is a folder.");
}

TEST_F(DeckFiles, ADeviceOrPipeIsAFileError) {
  EXPECT_EQ(messageOf([&] { Deck::read("/dev/zero", smallScene()); }),
            "FileError: /dev/zero cannot be read: it is no regular file, but a device.");
  const std::string pipe = folder_ + "/pipe";
  const int made = parallel::rank() == 0 ? mkfifo(pipe.c_str(), 0600) : 0;
  EXPECT_EQ(made, 0);
  EXPECT_EQ(messageOf([&] { Deck::read(pipe, smallScene()); }),
            "FileError: " + pipe + " cannot be read: it is no regular file, but a FIFO.");
}

TEST_F(DeckFiles, AnEmptyFileIsABadDeck) {
  const std::string file = write("empty.xml", "");
  EXPECT_EQ(messageOf([&] { Deck::read(file, smallScene()); }),
            file + ": the file is empty; a deck is one <ParameterList name=\"...\">.");
}

TEST_F(DeckFiles, ABinaryFileIsABadDeck) {
  const std::string file = write("binary.xml", std::string("\x89HDF\r\n\x1a\n\0\0\0", 11));
  EXPECT_EQ(messageOf([&] { Deck::read(file, smallScene()); }),
            file + ": is a binary file, not an XML text in UTF-8.");
}

TEST_F(DeckFiles, AHugeFileIsRefusedUnread) {
  const std::string file = write("huge.xml", "<");
  if (parallel::rank() == 0)
    std::filesystem::resize_file(file, 5000UL * 1024UL * 1024UL);  // sparse
  EXPECT_EQ(messageOf([&] { Deck::read(file, smallScene()); }),
            file + ": is larger than 64 MB, which cannot be a deck.");
}

TEST_F(DeckFiles, WindowsLineEndsCountAsLines) {
  std::string text = deckWith(parameter("Stiffness", "double", "x"), endTime);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.insert(at, "\r");
  const std::string file = write("windows.xml", text);
  EXPECT_EQ(messageOf([&] { Deck::read(file, smallScene()); }),
            file + ":3: /well/Contact/Stiffness: type=\"double\" value=\"x\" is not a number.");
}

TEST_F(DeckFiles, AByteOrderMarkIsFine) {
  const std::string file = write("bom.xml", "\xef\xbb\xbf" + good);
  EXPECT_EQ(Deck::read(file, smallScene()).name(), "well");
}

TEST_F(DeckFiles, LibrariesAreReadWithTheirOwnDescription) {
  const ListSpec library =
      ListSpec("library", "L.")
          .namedLists(ListSpec("component", "C.")
                          .real("Length", "m", Required{}, Range::positive(), "The length."));
  const Deck deck = Deck::read(
      write("scene.xml", deckWith(stiffness, endTime + parameter("Note", "string", "library.xml"))),
      smallScene());
  const std::string file =
      write("library.xml", "<ParameterList name=\"lib\">\n<ParameterList name=\"pipe\">" +
                               parameter("Length", "string", "30 ft") +
                               "</ParameterList></ParameterList>");
  const Deck pipes = deck.readNamed("Transient/Note", "library.xml", library);
  EXPECT_DOUBLE_EQ(pipes.list().sublist("pipe").get<double>("Length"), 9.144);
  EXPECT_EQ(pipes.where("pipe/Length"), file + ":2: /lib/pipe/Length");
  EXPECT_EQ(deck.readNamed("Transient/Note", file, library).file(), file);
}

TEST_F(DeckFiles, AMissingLibraryIsAFaultOfTheDeck) {
  const std::string scene = write(
      "scene.xml", deckWith(stiffness, endTime + "\n" + parameter("Note", "string", "no.xml")));
  const Deck deck = Deck::read(scene, smallScene());
  EXPECT_EQ(
      messageOf([&] { deck.readNamed("Transient/Note", "no.xml", ListSpec("library", "L.")); }),
      scene + ":7: /well/Transient/Note names a file, but " + folder_ +
          "/no.xml cannot be read: No such file or directory.");
}

TEST_F(DeckFiles, FaultsOfALibraryPointIntoTheLibrary) {
  const Deck deck = Deck::read(write("scene.xml", good), smallScene());
  const std::string file = write("library.xml",
                                 "<ParameterList name=\"lib\">\n<Parameter name=\"x\" type=\"int\" "
                                 "value=\"1\"/></ParameterList>");
  EXPECT_EQ(messageOf([&] { deck.readNamed("Title", "library.xml", ListSpec("library", "L.")); }),
            file + ":2: /lib/x is not a parameter. This list has no parameters.");
}

TEST(DeckPlaces, NamesOfFilesAreRelativeToTheDeck) {
  const auto resolved = [](const std::string& deckFile, const std::string& name) {
    return Deck::parse(good, deckFile, smallScene()).resolve(name);
  };
  EXPECT_EQ(resolved("deck.xml", "a/b.xml"), "a/b.xml");
  EXPECT_EQ(resolved("xml/deck.xml", "a/b.xml"), "xml/a/b.xml");
  EXPECT_EQ(resolved("/deck.xml", "b.xml"), "/b.xml");
  EXPECT_EQ(resolved("/a/deck.xml", "b.xml"), "/a/b.xml");
  EXPECT_EQ(resolved("/a/deck.xml", "/c/b.xml"), "/c/b.xml");
}

TEST(DeckPlaces, EveryPathHasALine) {
  const Deck deck = parseSmall(good);
  EXPECT_EQ(deck.where("Contact/Stiffness"), "deck.xml:3: /well/Contact/Stiffness");
  EXPECT_EQ(deck.where("/Contact/Stiffness"), "deck.xml:3: /well/Contact/Stiffness");
  EXPECT_EQ(deck.where("/well/Contact/Stiffness"), "deck.xml:3: /well/Contact/Stiffness");
  EXPECT_EQ(deck.where("well/Contact/Stiffness"), "deck.xml:3: /well/Contact/Stiffness");
  EXPECT_EQ(deck.where(deck.list().sublist("Contact").name() + "/Stiffness"),
            "deck.xml:3: /well/Contact/Stiffness");
  EXPECT_EQ(deck.where("Contact"), "deck.xml:2: /well/Contact");
  EXPECT_EQ(deck.where("Contact/Friction"), "deck.xml:2: /well/Contact/Friction")
      << "a default has the line of its list";
  EXPECT_EQ(deck.where("Mud/Density"), "deck.xml:1: /well/Mud/Density")
      << "an absent list has the line of the scene";
  EXPECT_EQ(deck.where(""), "deck.xml:1: /well");
  EXPECT_EQ(deck.where("/well"), "deck.xml:1: /well");
}

TEST(DeckPlaces, WhatIsGivenAndWhatIsADefault) {
  const Deck deck = parseSmall(good, {"Mud/Density=900"});
  EXPECT_TRUE(deck.gives("Contact/Stiffness"));
  EXPECT_TRUE(deck.gives("Mud"));
  EXPECT_TRUE(deck.gives("Mud/Density"));
  EXPECT_FALSE(deck.gives("Contact/Friction"));
  EXPECT_FALSE(deck.gives("Contact/Intervals"));
}

TEST(DeckPlaces, ErrorsContinueThePathOrFollowIt) {
  const Deck deck = parseSmall(good);
  EXPECT_EQ(deck.error("Contact/Stiffness", "is too small."),
            "deck.xml:3: /well/Contact/Stiffness is too small.");
  EXPECT_EQ(deck.error("Contact/Stiffness", "The bit is above the well."),
            "deck.xml:3: /well/Contact/Stiffness: The bit is above the well.");
}

TEST(DeckPlaces, AMessageThatBeginsWithAPathGetsItsLine) {
  const Deck deck = parseSmall(good);
  EXPECT_EQ(deck.located("/well/Contact/Stiffness is too small."),
            "deck.xml:3: /well/Contact/Stiffness is too small.");
  EXPECT_EQ(deck.located("/well/Transient/End Time: too short."),
            "deck.xml:6: /well/Transient/End Time: too short.");
  EXPECT_EQ(deck.located("/well/Contact/Friction is odd."),
            "deck.xml:2: /well/Contact/Friction is odd.");
  EXPECT_EQ(deck.located("/well is odd."), "deck.xml:1: /well is odd.");
  EXPECT_EQ(deck.located("/wellhead/x is odd."), "/wellhead/x is odd.");
  EXPECT_EQ(deck.located("The pivot is zero."), "The pivot is zero.");
}

TEST(Problems, ComeTogetherSortedByLine) {
  const Deck deck = parseSmall(good, {"Mud/Density=900"});
  Problems problems(deck);
  EXPECT_TRUE(problems.empty());
  EXPECT_NO_THROW(problems.raise());
  problems.add("Mud/Density", "is lighter than water.");
  problems.add("Transient/End Time", "is too short.");
  problems.add("Contact/Stiffness", "The contact is too soft.");
  problems.add("/well/Contact/Law", "is not meant for this well.");
  EXPECT_FALSE(problems.empty());
  EXPECT_EQ(messageOf([&] { problems.raise(); }),
            "deck.xml:2: /well/Contact/Law is not meant for this well.\n"
            "deck.xml:3: /well/Contact/Stiffness: The contact is too soft.\n"
            "deck.xml:6: /well/Transient/End Time is too short.\n"
            "--set Mud/Density=900: /well/Mud/Density is lighter than water.");
}

TEST(Problems, OfALibraryFollowThoseOfTheDeck) {
  const Deck deck = parseSmall(good);
  const Deck library =
      Deck::parse("<ParameterList name=\"lib\"><ParameterList name=\"pipe\"/></ParameterList>",
                  "a.xml", ListSpec("l", "L.").namedLists(ListSpec("c", "C.")));
  Problems problems(deck);
  problems.add(library, "pipe", "is thicker than the well.");
  problems.add("Transient/End Time", "is too short.");
  EXPECT_EQ(messageOf([&] { problems.raise(); }),
            "deck.xml:6: /well/Transient/End Time is too short.\na.xml:1: /lib/pipe is thicker "
            "than the well.");
}

TEST(Defaults, OfAListWithoutADeck) {
  const ListSpec list = ListSpec("RK4", "R.")
                            .real("Step", "s", 1e-3, Range::positive(), "S.")
                            .real("End", "s", Optional{}, Range::any(), "E.")
                            .requiredList(ListSpec("Sub", "S.").integer("N", 2, Range::any(), "N."))
                            .list(ListSpec("Not", "N."));
  const Teuchos::ParameterList values = defaults(list);
  EXPECT_EQ(values.get<double>("Step"), 1e-3);
  EXPECT_FALSE(values.isParameter("End"));
  EXPECT_EQ(values.sublist("Sub").get<int>("N"), 2);
  EXPECT_FALSE(values.isSublist("Not"));
  EXPECT_EQ(messageOf([] { defaults(smallScene()); }),
            "\"Transient/End Time\" is required but missing.");
}

}  // namespace DeckTest

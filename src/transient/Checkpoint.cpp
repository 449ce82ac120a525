// SPDX-License-Identifier: BSD-3-Clause
#include "transient/Checkpoint.hpp"

#include <algorithm>
#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/map.hpp>
#include <cstdio>
#include <sstream>

#include "common/Message.hpp"
#include "common/Sha256.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::transient {

template <class Archive>
void serialize(Archive& archive, State& state) {
  archive(state.t, state.q, state.v, state.a, state.x, state.xDot);
}

template <class Archive>
void serialize(Archive& archive, Counters& c) {
  // long has a different size on other machines
  const auto portable = [&archive](long& count) {
    auto number = static_cast<std::int64_t>(count);
    archive(number);
    count = static_cast<long>(number);
  };
  for (long* count : {&c.steps, &c.rejected, &c.halved, &c.newtonIterations, &c.unconvergedSteps,
                      &c.factorisations, &c.rightHandSides})
    portable(*count);
  for (long& count : c.strategies) portable(count);
  archive(c.minStep, c.maxStep);
}

template <class Archive>
void serialize(Archive& archive, CarriedMemory& carried) {
  archive(carried.vectors, carried.numbers);
}

namespace {

constexpr char magic[] = "Tooljoint checkpoint";
constexpr std::size_t magicLength = sizeof magic - 1;
/// Incremented whenever the format of the body changes, or of what an integrator, a point batch or
/// the ledger saves.
constexpr std::uint32_t layout = 26;
constexpr std::size_t digestLength = 64;  ///< hexadecimal digits
constexpr std::size_t headerLength =
    magicLength + sizeof layout + sizeof(std::uint64_t) + digestLength;

/// The numbers in the header are little-endian.
template <class Number>
std::string littleEndian(Number number) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof number; ++i)
    bytes += static_cast<char>((number >> (8 * i)) & 0xffU);
  return bytes;
}

template <class Number>
Number fromLittleEndian(const std::string& bytes, std::size_t at) {
  Number number = 0;
  for (std::size_t i = 0; i < sizeof number; ++i)
    number |= static_cast<Number>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return number;
}

template <class Archive, class Point>
void transfer(Archive& archive, Point& point) {
  archive(point.run, point.program, point.integrator, point.model, point.ranks, point.figures,
          point.state, point.counters, point.contactEvaluations, point.samples,
          point.runawaySamples, point.memory, point.carried, point.shares, point.recorder,
          point.rows);
}

[[noreturn]] void refuseLayout(const std::string& file, const std::string& found) {
  throw FileError("The checkpoint \"" + file + "\" has the layout " + found +
                  " of another version of the program; this one reads layout " +
                  std::to_string(layout) +
                  ". Go on with the program that wrote it, or run the deck from the start.");
}

/// Body of the file, verified against the length and the SHA-256 in the header.
std::string verifiedBody(const std::string& bytes, const std::string& file) {
  const auto damaged = [&file](const std::string& what) {
    throw FileError("The checkpoint \"" + file + "\" is damaged: " + what +
                    ". Restore it from a copy, or run the deck from the start.");
  };
  if (bytes.compare(0, magicLength, magic) != 0) {
    // layouts up to 5 begin with the length of a text "Tooljoint checkpoint N"
    const std::size_t text = sizeof(std::uint64_t), number = text + magicLength + 1;
    if (bytes.compare(std::min(text, bytes.size()), magicLength, magic) == 0 &&
        bytes.size() > number)
      refuseLayout(file, bytes.substr(number, 1));
    throw FileError("\"" + file + "\" is not a checkpoint.");
  }
  if (bytes.size() < headerLength) damaged("it is cut short within its header");
  const auto found = fromLittleEndian<std::uint32_t>(bytes, magicLength);
  if (found != layout) refuseLayout(file, std::to_string(found));
  const auto length = fromLittleEndian<std::uint64_t>(bytes, magicLength + sizeof layout);
  std::string body = bytes.substr(headerLength);
  if (body.size() != length)
    damaged("its header promises " + std::to_string(length) + " bytes, " +
            std::to_string(body.size()) + " follow");
  if (sha256(body) != bytes.substr(headerLength - digestLength, digestLength))
    damaged("its SHA-256 does not match its content");
  return body;
}

}  // namespace

std::string Checkpoint::encode() const {
  std::ostringstream out;
  {
    cereal::PortableBinaryOutputArchive archive(out);
    transfer(archive, *this);
  }
  const std::string body = out.str();
  return magic + littleEndian(layout) + littleEndian(static_cast<std::uint64_t>(body.size())) +
         sha256(body) + body;
}

Checkpoint Checkpoint::decode(const std::string& bytes, const std::string& file) {
  std::istringstream in(verifiedBody(bytes, file));
  Checkpoint point;
  cereal::PortableBinaryInputArchive archive(in);
  transfer(archive, point);
  return point;
}

void Checkpoint::write(const std::string& file) const {
  try {
    io::writeText(file, encode());
  } catch (const FileError&) {
    std::remove((file + ".part").c_str());  // on a full disk the results may need this space
    throw;
  }
}

Checkpoint Checkpoint::read(const std::string& file) { return decode(io::readText(file), file); }

}  // namespace tooljoint::transient

// SPDX-License-Identifier: BSD-3-Clause
#include "transient/Checkpoint.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>

#include "common/Error.hpp"

namespace tooljoint::transient {
namespace {

constexpr char family[] = "Tooljoint checkpoint ";
/// Counts up whenever Counters or anything that save() writes changes.
constexpr char version[] = "5";

class Writer {
 public:
  explicit Writer(const std::string& file) : out_(file, std::ios::binary) {}
  template <class T>
  void one(const T& x) {
    out_.write(reinterpret_cast<const char*>(&x), sizeof x);
  }
  void text(const std::string& s) {
    one(static_cast<std::uint64_t>(s.size()));
    out_.write(s.data(), static_cast<std::streamsize>(s.size()));
  }
  void numbers(const double* x, std::size_t n) {
    one(static_cast<std::uint64_t>(n));
    out_.write(reinterpret_cast<const char*>(x), static_cast<std::streamsize>(n * sizeof(double)));
  }
  bool good() { return static_cast<bool>(out_.flush()); }

 private:
  std::ofstream out_;
};

class Reader {
 public:
  explicit Reader(const std::string& file) : in_(file, std::ios::binary) {}
  template <class T>
  T one() {
    T x{};
    in_.read(reinterpret_cast<char*>(&x), sizeof x);
    return x;
  }
  std::size_t length() {
    const auto n = one<std::uint64_t>();
    if (!in_ || n > (std::uint64_t{1} << 32)) in_.setstate(std::ios::failbit);
    return in_ ? static_cast<std::size_t>(n) : 0;
  }
  std::string text() {
    std::string s(length(), ' ');
    in_.read(s.data(), static_cast<std::streamsize>(s.size()));
    return s;
  }
  std::vector<double> numbers() {
    std::vector<double> x(length());
    in_.read(reinterpret_cast<char*>(x.data()), static_cast<std::streamsize>(x.size() * sizeof(double)));
    return x;
  }
  Vector vector() {
    const auto x = numbers();
    return Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
  }
  bool good() const { return static_cast<bool>(in_); }

 private:
  std::ifstream in_;
};

}  // namespace

void Checkpoint::write(const std::string& file) const {
  const std::string part = file + ".part";
  Writer out(part);
  out.text(std::string(family) + version);
  out.text(integrator);
  out.one(fingerprint);
  out.one(state.t);
  for (const Vector* x : {&state.q, &state.v, &state.a}) out.numbers(x->data(), static_cast<std::size_t>(x->size()));
  out.one(counters);
  out.one(contactEvaluations);
  out.one(samples);
  out.numbers(memory.data(), memory.size());
  if (!out.good() || std::rename(part.c_str(), file.c_str()) != 0)
    throw FileError("Cannot write the checkpoint \"" + file + "\": is the folder writable and the disk not full?");
}

Checkpoint Checkpoint::read(const std::string& file) {
  Reader in(file);
  if (!in.good()) throw FileError("Cannot open the checkpoint \"" + file + "\".");
  const std::string magic = in.text();
  if (magic.rfind(family, 0) != 0) throw FileError("\"" + file + "\" is not a checkpoint.");
  const std::string written = magic.substr(sizeof family - 1);
  if (written != version)
    throw FileError("The checkpoint \"" + file + "\" has the layout " + written + " of another version of the program; this one reads layout " +
                    version + ". Go on with the program that wrote it, or run the deck from the start.");
  Checkpoint point;
  point.integrator = in.text();
  point.fingerprint = in.one<double>();
  point.state.t = in.one<double>();
  for (Vector* x : {&point.state.q, &point.state.v, &point.state.a}) *x = in.vector();
  point.counters = in.one<Counters>();
  point.contactEvaluations = in.one<long>();
  point.samples = in.one<long>();
  point.memory = in.numbers();
  if (!in.good()) throw FileError("The checkpoint \"" + file + "\" is cut short.");
  return point;
}

double fingerprint(const CompiledModel& model) {
  double sum = model.size();
  const auto add = [&sum](const auto& values) {
    double weight = 1;
    for (double x : values) sum += weight * x, weight = weight < 1e3 ? weight * 1.0009765625 : 1.0;
  };
  const auto& source = model.source();
  const auto addSparse = [&](const Sparse& m) {
    Vector values(m.nonZeros());
    Eigen::Index k = 0;
    for (int i = 0; i < m.outerSize(); ++i)
      for (Sparse::InnerIterator it(m, i); it; ++it) values[k++] = it.value();
    add(values);
  };
  addSparse(source.mass);
  for (const auto& term : source.damping) addSparse(term.matrix);
  for (const auto& term : source.stiffness) addSparse(term.matrix);
  for (const auto& term : source.loads) add(term.vector);
  for (const auto& set : source.points) add(set.offset);
  return sum;
}

}  // namespace tooljoint::transient

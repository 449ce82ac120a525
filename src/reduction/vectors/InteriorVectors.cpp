// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/InteriorVectors.hpp"

namespace tooljoint::reduction {

Vector InteriorVectors::eigenvalues() const {
  Vector values(sizeOf(vectors));
  for (int k = 0; k < sizeOf(vectors); ++k) values[k] = vectors[at(k)].eigenvalue;
  return values;
}

int InteriorVectors::rigid() const {
  return static_cast<int>(std::count_if(vectors.begin(), vectors.end(),
                                        [](const ModalVector& vector) { return vector.rigid; }));
}

Matrix InteriorVectors::columns(const std::vector<int>& which, int size) const {
  Matrix all = Matrix::Zero(size, sizeOf(which));
  for (int j = 0; j < sizeOf(which); ++j) {
    const ModalVector& vector = vectors[at(which[at(j)])];
    all(groups[at(vector.group)], j) = vector.shape;
  }
  return all;
}

void InteriorVectors::keepAll() {
  std::stable_sort(vectors.begin(), vectors.end(), [](const ModalVector& a, const ModalVector& b) {
    return a.eigenvalue < b.eigenvalue;
  });
  kept = sizeOf(vectors);
}

void InteriorVectors::remarkOnCount(const ModeRequest& request, int available,
                                    const std::string& what) {
  if (request.kind != ModeRequest::Kind::Count) return;
  const std::string asked = "requested " + std::to_string(request.count) + " " + what + ", kept ";
  if (request.count > available)
    remarks.push_back(asked + "all " + std::to_string(available));
  else if (kept > request.count)
    remarks.push_back(asked + std::to_string(kept) + " to keep a close pair together");
}

}  // namespace tooljoint::reduction

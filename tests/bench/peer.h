#pragma once
// One way to put a solid on a part: the same three questions to each peer.

#include "vcg_ext/validate.h"

#include <memory>
#include <string>

namespace bench {

using vcg::textlabel::IndexedMesh;

/// What to do with the part and the prism.
enum class Operation { Union, Difference };

class Peer {
public:
	virtual ~Peer() = default;
	/// Name and version, and how many threads it works with, as far as it can be told.
	virtual std::string about() const = 0;
	/// Make both meshes what the peer calls a mesh; not timed.
	virtual void load(const IndexedMesh& part, const IndexedMesh& prism) = 0;
	/// Run once, what the peer calls a mesh at both ends.
	/// @param[out] result  if not null
	/// @return seconds; negative when the peer refuses
	virtual double runAlone(Operation operation, IndexedMesh* result) = 0;
	/// Run once from arrays to arrays: what a program pays that has a mesh of its own, positions and faces.
	/// @return seconds; negative when the peer refuses
	virtual double run(Operation operation) = 0;
};

/// CGAL's corefinement; null when built without it.
std::unique_ptr<Peer> MakeCgal();
/// Manifold by a Python that has manifold3d; null when it has not.
/// @param[in] python  the interpreter
/// @param[in] folder  for the meshes that are handed over
std::unique_ptr<Peer> MakeManifold(const std::string& python, const std::string& folder);

/// Pairs of faces that cross, by CGAL's self_intersections(); -1 when built without CGAL or the mesh is not a manifold.
int CountCrossings(const IndexedMesh& mesh);

}  // namespace bench

#pragma once
/// \file
/// Measurements as a table for other programs: the stems.csv of the file formats, one row a segment.

#include "quantify/types.hpp"

#include <string>

namespace axil::quantify {

/// `segment,stem,parent,level,kind,length,radius,rotr,rotu,rx,ry,rz,dx,dy,dz,leaves`, then a row a segment in the order of
/// Measurements::segments, numbered from 0. `parent` is empty for segments that leave the collar, `radius` where nobody
/// measured one. Angles in radians, lengths in the unit of the measurements, numbers as the shortest text that reads back exactly.
[[nodiscard]] std::string segmentsCsv(const Measurements& measurements);

}  // namespace axil::quantify

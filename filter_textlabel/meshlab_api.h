#pragma once
// MeshLab's own headers, whose places differ between its generations: scalar types, layers, parameter lists.

#if MESHLAB_API == 2020
#include <common/filter_parameter/rich_parameter.h>
#include <common/filter_parameter/rich_parameter_list.h>
#include <common/filterscript.h>
#include <common/meshmodel.h>
#include <common/ml_mesh_type.h>
#else
#include <common/ml_document/mesh_document.h>
#include <common/parameters/rich_parameter_list.h>
#endif

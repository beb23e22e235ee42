// A liquid's material for renderers that do not know of liquids.
#pragma once

#include "host/export/document.h"
#include "host/scene/scene.h"

namespace meniscal::gltf {

// `material` (the file's) with what it means to this renderer spelt out in glTF's own terms, and no liquid any more:
// its surface is to be taken as it is. `thickness`, metres, where the file states none. Textures are left out with a
// warning: the new surface has no texture coordinates. `document` gets the extensions that are used.
OrderedJson spell_out_liquid(OrderedJson material, const Material& meaning, double thickness, Document& document,
                             Messages& messages);

// Takes out of all materials their contact angles with this liquid, by the name of its material.
void forget_contact_angles(Document& document, const std::string& liquid);

}  // namespace meniscal::gltf

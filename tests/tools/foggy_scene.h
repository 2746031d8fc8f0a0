#pragma once
// A scene in which every kind of sum is in play.

#include <string>

namespace pbrt::test {

// Metaballs and a light in fog, a lens, a filter that reaches over pixels and tiles. No window of
// the picture is a whole number of tiles. It takes about 10 ms a sample per pixel.
inline std::string foggyScene(const std::string& sampler = "halton",
                              const std::string& filter = "gaussian") {
  return R"(LookAt 0 2 -5  0 0.5 0  0 1 0
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [.02 .02 .03] "rgb sigma_s" [.1 .1 .1]
MediumInterface "" "fog"
Camera "perspective" "float fov" 40 "float lensradius" 0.1 "float focaldistance" 5
Film "image" "integer xresolution" 70 "integer yresolution" 50 "string filename" "out.exr"
PixelFilter ")" +
         filter + R"(" "float xwidth" 1.5 "float ywidth" 1.5
Integrator "volpath" "integer maxdepth" 4
Sampler ")" +
         sampler + R"("
WorldBegin
MediumInterface "fog" "fog"
LightSource "point" "point from" [3 5 -3] "rgb I" [40 40 40]
AttributeBegin
AreaLightSource "diffuse" "rgb L" [9 8 7]
Translate -2 3 -1
Shape "sphere" "float radius" 0.5
AttributeEnd
Material "matte" "rgb Kd" [0.6 0.4 0.2]
Shape "metaballs" "string kernel" "wyvill" "float radius" 1.1 "point P" [-0.4 0.3 0  0.4 0.3 0]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-9 -0.8 -9  -9 -0.8 9  9 -0.8 9  9 -0.8 -9]
WorldEnd
)";
}

}  // namespace pbrt::test

// The toys, each modelled standing on y = 0 around the y axis, in metres, facing +z. Each adds a mesh and returns it.
#pragma once

#include "scene/builtin/paints.hpp"

namespace dioptre::builtin {

/// Grey pictures that the toys tint.
struct ToyPictures {
    int paint, wood, felt, metal;
};
ToyPictures addToyPictures(Model& model);

// Turned and moulded: toys_turned.cpp
int addBall(Model& model);
int addTop(Model& model, const ToyPictures& pictures);
int addDoll(Model& model);
int addRingStack(Model& model, const ToyPictures& pictures);
int addDrum(Model& model, const ToyPictures& pictures);
int addSkittle(Model& model, const ToyPictures& pictures);
int addRocket(Model& model, const ToyPictures& pictures);
int addMarble(Model& model, const vec3& color);

// Put together from parts: toys_built.cpp
int addBlock(Model& model, const char* letters, std::uint32_t colors);
int addDie(Model& model);
int addLocomotive(Model& model, const ToyPictures& pictures);
int addWagon(Model& model, const ToyPictures& pictures, const vec3& color, bool logs);
int addRobot(Model& model, const ToyPictures& pictures);
int addGears(Model& model, const ToyPictures& pictures);
int addKnot(Model& model, const ToyPictures& pictures);
int addXylophone(Model& model, const ToyPictures& pictures);
int addKite(Model& model, const ToyPictures& pictures);

// Soft and blown: toys_soft.cpp
int addDuck(Model& model, const ToyPictures& pictures);
int addTeddy(Model& model, const ToyPictures& pictures);
int addHorse(Model& model, const ToyPictures& pictures);
int addOctopus(Model& model, const ToyPictures& pictures);
int addCar(Model& model, const ToyPictures& pictures);

}  // namespace dioptre::builtin

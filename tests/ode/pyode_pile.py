"""A pile of balls and boxes in ODE by way of Debian's python3-pyode, to which Harpoon is unknown.
Prints the state of every body at the end, exactly.

    python3 pyode_pile.py simple|hash|quadtree BODIES STEPS
"""

import random
import sys

import ode


def make_space(kind):
    if kind == "simple":
        return ode.SimpleSpace()
    if kind == "hash":
        return ode.HashSpace()
    return ode.QuadTreeSpace((0, 0, 0), (20, 20, 20), 4)


def near(arguments, geom1, geom2):
    world, joints = arguments
    for contact in ode.collide(geom1, geom2):
        contact.setBounce(0.1)
        contact.setMu(50)
        ode.ContactJoint(world, joints, contact).attach(geom1.getBody(), geom2.getBody())


def main():
    kind, bodies, steps = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    numbers = random.Random(7)
    world = ode.World()
    world.setGravity((0, -9.81, 0))
    world.setERP(0.8)
    world.setCFM(1e-5)
    space = make_space(kind)
    joints = ode.JointGroup()
    keep = [ode.GeomPlane(space, (0, 1, 0), -1)]
    pile = []
    for number in range(bodies):
        body = ode.Body(world)
        mass = ode.Mass()
        if number % 3:
            mass.setSphere(1000, 0.3)
            geom = ode.GeomSphere(space, 0.3)
        else:
            mass.setBox(1000, 0.5, 0.4, 0.6)
            geom = ode.GeomBox(space, (0.5, 0.4, 0.6))
        body.setMass(mass)
        body.setPosition((numbers.uniform(-1.5, 1.5), 1 + 0.1 * number, numbers.uniform(-1.5, 1.5)))
        geom.setBody(body)
        keep.append(geom)
        pile.append(body)
    for _ in range(steps):
        space.collide((world, joints), near)
        world.quickStep(0.01)
        joints.empty()
    for body in pile:
        print(*(value.hex() for value in (*body.getPosition(), *body.getLinearVel())))


main()

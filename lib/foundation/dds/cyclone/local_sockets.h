#pragma once

namespace robosim::dds {

/// Makes the sockets of this process that receive messages of a domain ignore packets from other machines: Cyclone DDS
/// binds them to all addresses, so that it receives from every network, whatever interface is configured. Packets that
/// come by the loopback interface, and multicasts of this machine, pass.
/// @throws std::runtime_error when that is not possible
void ignoreOtherMachines(int domain);

}  // namespace robosim::dds

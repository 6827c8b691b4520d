<!-- SPDX-FileCopyrightText: The Far-LoD authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
<CityModel xmlns="http://www.opengis.net/citygml/3.0" xmlns:c="http://www.opengis.net/citygml/3.0"
 xmlns:b="http://www.opengis.net/citygml/building/3.0" xmlns:t="http://www.opengis.net/citygml/tunnel/3.0"
 xmlns:n="http://www.opengis.net/citygml/construction/3.0" xmlns:d="http://www.opengis.net/citygml/relief/3.0"
 xmlns:g="http://www.opengis.net/gml/3.2" xmlns:x="http://www.w3.org/1999/xlink">
<cityObjectMember><t:Tunnel g:id="t"><c:boundary><n:RoofSurface><c:lod2MultiSurface><g:MultiSurface><g:surfaceMember>
<g:Polygon><g:exterior><g:LinearRing><g:posList>0 0 0 9 0 0 9 9 0 0 0 0</g:posList></g:LinearRing></g:exterior></g:Polygon>
</g:surfaceMember></g:MultiSurface></c:lod2MultiSurface></n:RoofSurface></c:boundary>
<t:tunnelInstallation><t:TunnelInstallation><c:lod2ImplicitRepresentation><c:ImplicitGeometry>
<c:transformationMatrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</c:transformationMatrix>
<c:relativeGeometry><g:MultiSurface g:id="p"><g:surfaceMember><g:Polygon><g:exterior><g:LinearRing>
<g:posList>0 0 0 1 0 0 1 1 0 0 0 0</g:posList></g:LinearRing></g:exterior></g:Polygon></g:surfaceMember></g:MultiSurface></c:relativeGeometry>
<c:referencePoint><g:Point><g:pos>500 500 5</g:pos></g:Point></c:referencePoint></c:ImplicitGeometry></c:lod2ImplicitRepresentation>
<n:relationToConstruction>outside</n:relationToConstruction></t:TunnelInstallation></t:tunnelInstallation></t:Tunnel></cityObjectMember>
<cityObjectMember><n:OtherConstruction><c:boundary><n:GroundSurface><c:lod0MultiSurface x:href="#p"/></n:GroundSurface></c:boundary>
<n:height><n:Height><n:value>3</n:value></n:Height></n:height><c:lod1ImplicitRepresentation><c:ImplicitGeometry><c:relativeGeometry x:href="#p"/>
<c:referencePoint><g:Point><g:pos>500 500 5</g:pos></g:Point></c:referencePoint></c:ImplicitGeometry></c:lod1ImplicitRepresentation>
</n:OtherConstruction></cityObjectMember>
<cityObjectMember><d:ReliefFeature><d:reliefComponent><d:TINRelief><d:tin><g:Tin><g:patches><g:Triangle><g:exterior><g:LinearRing>
<g:posList>0 0 0 9 0 0 9 9 0 0 0 0</g:posList></g:LinearRing></g:exterior></g:Triangle></g:patches><g:controlPoint><g:posList>1 1 1</g:posList>
</g:controlPoint></g:Tin></d:tin></d:TINRelief></d:reliefComponent></d:ReliefFeature></cityObjectMember>
<cityObjectMember><u:Tree xmlns:u="urn:u"/></cityObjectMember></CityModel>
